// Nothing is written; samples are counted.
#version 450 core

void main() {}
