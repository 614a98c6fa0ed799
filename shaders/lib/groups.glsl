// Numbers of workgroups and threads of a dispatch that is wider than one row of workgroups (visibility/dispatch.h).
// The last row may be incomplete: numbers can lie behind the last one.

uint groupNumber() { return gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x; }

/// In kernels with kObjectGroupSize threads per workgroup.
uint threadNumber() { return groupNumber() * kObjectGroupSize + gl_LocalInvocationID.x; }
