// Values of animated properties at MotionView.seconds (glTF 2.0, appendix C). Needs motionView, tracks and numbers.

/// The keys around the time.
struct KeySpan {
  uint first;
  uint second;
  float share;   // of the second, 0 to 1
  float length;  // seconds between them; 0 where first is second
};

KeySpan findKeys(MotionTrack track) {
  uint low = 0u;  // the first key behind the time lies in [low, high]
  uint high = track.keyCount;
  while (low < high) {
    uint middle = (low + high) / 2u;
    if (numbers[track.firstTime + middle] > motionView.seconds)
      high = middle;
    else
      low = middle + 1u;
  }
  if (low == 0u) return KeySpan(0u, 0u, 0.0, 0.0);
  if (low == track.keyCount) return KeySpan(low - 1u, low - 1u, 0.0, 0.0);
  float start = numbers[track.firstTime + low - 1u];
  float span = numbers[track.firstTime + low] - start;
  return KeySpan(low - 1u, low, span > 0.0 ? (motionView.seconds - start) / span : 0.0, span);
}

/// @param part  of a key with tangents: 0 the in-tangent, 1 the value, 2 the out-tangent
float numberOf(MotionTrack track, uint key, uint part, uint component) {
  uint value = track.interpolation == kMotionCubic ? 3u * key + part : key;
  return numbers[track.firstValue + value * track.width + component];
}

/// One component, without regard to the length of rotations.
float componentAt(MotionTrack track, KeySpan span, uint component) {
  float value = numberOf(track, span.first, 1u, component);
  if (span.first == span.second || track.interpolation == kMotionStep) return value;
  float next = numberOf(track, span.second, 1u, component);
  float t = span.share;
  if (track.interpolation == kMotionLinear) return value + (next - value) * t;
  float t2 = t * t;
  float t3 = t2 * t;
  float leaving = numberOf(track, span.first, 2u, component);
  float arriving = numberOf(track, span.second, 0u, component);
  return (2.0 * t3 - 3.0 * t2 + 1.0) * value + span.length * (t3 - 2.0 * t2 + t) * leaving +
         (3.0 * t2 - 2.0 * t3) * next + span.length * (t3 - t2) * arriving;
}

vec3 vectorAt(uint index, vec3 rest) {
  if (index == kNoMotion) return rest;
  MotionTrack track = tracks[index];
  KeySpan span = findKeys(track);
  return vec3(componentAt(track, span, 0u), componentAt(track, span, 1u), componentAt(track, span, 2u));
}

vec4 keyRotation(MotionTrack track, uint key) {
  return normalize(vec4(numberOf(track, key, 1u, 0u), numberOf(track, key, 1u, 1u), numberOf(track, key, 1u, 2u),
                        numberOf(track, key, 1u, 3u)));
}

/// Spherical linear interpolation along the shorter arc.
vec4 slerp(vec4 a, vec4 b, float t) {
  float cosine = dot(a, b);
  if (cosine < 0.0) {
    b = -b;
    cosine = -cosine;
  }
  if (cosine > 0.9995) return normalize(mix(a, b, t));  // the arc is too short for its sine
  float angle = acos(cosine);
  return normalize((sin((1.0 - t) * angle) * a + sin(t * angle) * b) / sin(angle));
}

vec4 rotationAt(uint index, vec4 rest) {
  if (index == kNoMotion) return rest;
  MotionTrack track = tracks[index];
  KeySpan span = findKeys(track);
  if (track.interpolation == kMotionLinear && span.first != span.second)
    return slerp(keyRotation(track, span.first), keyRotation(track, span.second), span.share);
  return normalize(vec4(componentAt(track, span, 0u), componentAt(track, span, 1u), componentAt(track, span, 2u),
                        componentAt(track, span, 3u)));
}
