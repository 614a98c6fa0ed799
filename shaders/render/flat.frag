// One colour per primitive.
#version 450 core

flat in vec3 tint;
layout(location = 0) out vec4 frameColor;

void main() { frameColor = vec4(tint, 1.0); }
