// Products of affine transforms that are stored as three rows. Needs lib/transform.glsl.

vec4 rowOfProduct(vec4 row, Transform b) {
  return row.x * b.worldFromObject0 + row.y * b.worldFromObject1 + row.z * b.worldFromObject2 +
         vec4(0.0, 0.0, 0.0, row.w);
}

/// a * b: b is applied first.
Transform product(Transform a, Transform b) {
  return Transform(rowOfProduct(a.worldFromObject0, b), rowOfProduct(a.worldFromObject1, b),
                   rowOfProduct(a.worldFromObject2, b));
}
