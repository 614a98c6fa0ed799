// mark_ghosts.comp against its CPU twin: every combination of marks with every verdict, and random words.
#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "core/random.h"
#include "gl/buffer.h"
#include "policy/cull_mode.h"
#include "shared/limits.h"
#include "support/gl_test.h"
#include "visibility/ghost_reference.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {
namespace {

constexpr gpu::uint kOutside = 0xabababab;  ///< what the target buffers hold before the kernel runs

struct Input {
  std::vector<gpu::Chain> chains;
  std::vector<gpu::Object> objects;
  std::vector<gpu::ObjectState> states;
  std::vector<gpu::uint> marks;

  void add(gpu::uint chain, const gpu::ObjectState& state, gpu::uint mark) {
    objects.push_back({chain, 0, static_cast<gpu::uint>(objects.size()), 0});
    states.push_back(state);
    marks.push_back(mark);
  }
};

Input chainsOnly() {
  Input input;
  for (const gpu::uint lodCount : {1U, 2U, 7U, gpu::kMaxLods}) {
    input.chains.emplace_back();
    input.chains.back().lodCount = lodCount;
  }
  return input;
}

template <class T>
gl::Buffer upload(const std::vector<T>& values, const char* name) {
  return gl::Buffer::fromArray(std::span<const T>(values), name);
}

class GhostGl : public test::GlTest {
 protected:
  /// Runs the kernel and compares every object, and one element behind the last, with the twin.
  static void compare(const Input& input, CullMode mode) {
    const std::size_t count = input.objects.size();
    gpu::CullView view{};
    view.objectCount = static_cast<gpu::uint>(count);
    view.traits = traitsOf(mode);
    const gl::Buffer viewBuffer(sizeof view, 0, "view", &view);
    const gl::Buffer objects = upload(input.objects, "objects");
    const gl::Buffer chains = upload(input.chains, "chains");
    const gl::Buffer states = upload(input.states, "states");
    const gl::Buffer marks = upload(input.marks, "marks");
    const gl::Buffer ghostMarks = upload(std::vector<gpu::uint>(count + 1, kOutside), "ghost marks");
    const gl::Buffer ghostStates =
        upload(std::vector<gpu::ObjectState>(count + 1, {kOutside, kOutside, kOutside, 0.0F}), "ghost states");
    viewBuffer.bindUniform(gpu::kBindingCullView);
    objects.bindStorage(gpu::kBindingObjects);
    chains.bindStorage(gpu::kBindingChains);
    states.bindStorage(gpu::kBindingStates);
    marks.bindStorage(gpu::kBindingMarks);
    ghostStates.bindStorage(gpu::kBindingGhostStates);
    ghostMarks.bindStorage(gpu::kBindingGhostMarks);
    const gl::Program program(programSource(ProgramId::kMarkGhosts));
    program.use();
    glDispatchCompute(static_cast<GLuint>(count / gpu::kObjectGroupSize + 1), 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    const auto actualMarks = ghostMarks.read<gpu::uint>(count + 1);
    const auto actualStates = ghostStates.read<gpu::ObjectState>(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
      const Ghost expected =
          ghostOf(input.chains[input.objects[i].chain], input.states[i], input.marks[i], rowOf(mode).twoPhases);
      ASSERT_EQ(actualMarks[i], expected.marks) << "object " << i << ", marks " << input.marks[i];
      ASSERT_EQ(std::memcmp(&actualStates[i], &expected.state, sizeof expected.state), 0) << "object " << i;
    }
    EXPECT_EQ(actualMarks[count], kOutside);
    EXPECT_EQ(actualStates[count].verdict, kOutside);
  }
};

TEST_F(GhostGl, EveryCombinationOfMarksWithEveryVerdict) {
  Input input = chainsOnly();
  for (gpu::uint mark = 0; mark < 2 * gpu::kMarkMeasured; ++mark)
    input.add(mark % 4, {mark % gpu::kVerdictCount, mark % 3, 1 + mark % gpu::kMaxTessellationLevel, -1.0F}, mark);
  for (const CullModeRow& mode : cullModeTable())
    compare(input, mode.id);
}

TEST_F(GhostGl, RandomWordsAtTheEdgesOfWorkgroups) {
  for (const std::size_t count :
       {std::size_t{1}, std::size_t{63}, std::size_t{64}, std::size_t{65}, std::size_t{3000}}) {
    Input input = chainsOnly();
    Random random(count);
    for (std::size_t i = 0; i < count; ++i)
      input.add(random.below(4),
                {random.below(gpu::kVerdictCount), random.below(32), random.below(21), random.uniform()},
                random.below(0xffffffffU));
    compare(input, CullMode::kHom);
    compare(input, CullMode::kHiz);
  }
}

}  // namespace
}  // namespace jalousie::visibility
