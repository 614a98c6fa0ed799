  vec3 positionWorld;
  vec3 normalWorld;
  TextureCoordinates uv;
  vec4 color;
  flat vec3 tint;       // colour of a debug view, if one is on
  flat uint material;
  flat uint mirrored;
  flat uint objectId;
  flat float fade;      // share of a level in a cross-fade; negative: it fades out
