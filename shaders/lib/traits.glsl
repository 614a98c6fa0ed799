// The traits of the frame's policy. Include after the block of CullView. C++ twin: has() of src/policy/traits.h

/// @param trait  kTrait... of shared/traits.h
bool hasTrait(uint trait) { return (cullView.traits & trait) != 0u; }
