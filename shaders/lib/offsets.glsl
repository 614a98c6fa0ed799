// Offsets after the prefix sum. Include lib/list_buffers.glsl before.

/// Totals per block before the second prefix sum, offsets of the blocks after it.
layout(std430, binding = kBindingBlockSums) readonly buffer BlockSumBlock { uint blockSums[]; };

/// Instances in front of an entry.
uint offsetOf(uint entry) { return entries[entry] + blockSums[entry / kScanBlock]; }

/// All instances: the sum up to the zero behind the last count.
uint totalInstances() { return offsetOf(listView.entryCount - 1u); }
