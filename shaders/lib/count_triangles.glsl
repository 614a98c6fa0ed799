// Counters of a workgroup, added to those of the frame at its end. Include the block of counters before.

shared uint groupCounters[kObjectGroupSize];

void countTriangles(uint triangles) {
  for (uint limb = 0u; limb < 4u; ++limb)
    atomicAdd(groupCounters[kCounterTriangles + limb], (triangles >> (10u * limb)) & 1023u);
}

/// Every lane of the workgroup has to call it, after a barrier.
void addGroupCounters(uint lane) {
  if (lane < kCounterCount && groupCounters[lane] > 0u) atomicAdd(counters[lane], groupCounters[lane]);
}
