// Places in the work of a list (shared/face_structs.h). Needs listView and faceView.

uint faceHead(uint instance) {
  return 2u * listView.capacity + 1u + instance * (kFaceHead + 2u * faceView.mostRanges);
}

/// Numbers of the solid and the sheet commands that write_commands.comp left.
uint faceOldCounts() { return faceHead(listView.capacity); }
