// The look of a shaded frame: one key light, a sky and ground light, a soft highlight, a filmic shoulder.

/// Whether a view shows the surfaces as they are: by itself, or under something else.
bool isShadedView(uint view) {
  return view == kViewShaded || view == kViewOcclusion || view == kViewOverdraw || view == kViewGhosts ||
         view == kViewDensity;
}

/// Light that a surface reflects to the eye, linear.
vec3 lightFrom(vec3 albedo, vec3 normal, vec3 toEye, vec3 toLight) {
  float key = max(dot(normal, toLight), 0.0);
  float sky = 0.5 + 0.5 * normal.y;
  vec3 ambient = mix(vec3(0.11, 0.09, 0.08), vec3(0.26, 0.32, 0.42), sky);
  vec3 halfway = normalize(toLight + toEye);
  float highlight = 0.12 * pow(max(dot(normal, halfway), 0.0), 32.0) * key;
  float rim = 0.10 * pow(1.0 - max(dot(normal, toEye), 0.0), 3.0) * sky;
  return albedo * (ambient + key * vec3(1.05, 0.97, 0.84)) + highlight + rim * vec3(0.8, 0.9, 1.0);
}

/// The shoulder.
vec3 exposed(vec3 light) { return vec3(1.0) - exp(-1.15 * light); }

/// Enough light to read shape under a flat colour.
vec3 shadeFlat(vec3 color, vec3 normal, vec3 toEye) {
  return color * (0.45 + 0.55 * max(dot(normal, toEye), 0.0));
}
