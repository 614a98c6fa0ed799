// The viewer with files of the corpus of broken files: a message with the reason for each, and the program goes on.
#include "support/corpus.h"
#include "view_fixture.h"

namespace jalousie {
namespace {

/// One viewer for all files: ViewTest opens it, CorpusTest makes the files.
class ViewCorpus : public test::CorpusTest {};

class ViewerOfFiles : public test::ViewTest {
 public:
  void TestBody() override {}
  bool start() {
    SetUp();
    return open({});
  }
  void stop() { TearDown(); }
  /// Drops a file on the window, and closes it again. @return the message; nullopt if there is no document
  std::optional<std::string> messageOf(const std::filesystem::path& file) {
    GLFWdropfun drop = glfwSetDropCallback(window_->handle(), nullptr);
    glfwSetDropCallback(window_->handle(), drop);
    const std::string name = file.string();
    const char* paths[] = {name.c_str()};
    drop(window_->handle(), 1, paths);
    settle();
    if (viewer_->documentCount() != 1U) return std::nullopt;
    std::string message = viewer_->document(0).error();
    key("ctrl+w");
    return message;
  }
  std::size_t documents() const { return viewer_->documentCount(); }
};

TEST_F(ViewCorpus, FilesAreShownOrRefusedWithTheirReason) {
  ViewerOfFiles viewer;
  if (!viewer.start()) GTEST_SKIP() << "no display";
  std::size_t shown = 0;
  std::size_t refused = 0;
  for (std::size_t i = 0; i < cases_.size(); ++i) {
    const test::CorpusCase& file = cases_[i];
    const bool chosen = file.runtime.code == 0 || file.runtime.code != file.baker.code || i % 20 == 0;
    if (!file.isGltf() || !chosen || std::filesystem::is_directory(file.input)) continue;
    SCOPED_TRACE(file.name);
    const std::optional<std::string> message = viewer.messageOf(file.input);
    ASSERT_TRUE(message.has_value());
    EXPECT_EQ(message->empty(), file.runtime.code == 0) << *message;
    EXPECT_NE(message->find(file.runtime.reason), std::string::npos) << *message << " lacks: " << file.runtime.reason;
    ASSERT_EQ(viewer.documents(), 0U);
    ++(file.runtime.code == 0 ? shown : refused);
  }
  EXPECT_GE(shown, 15U);
  EXPECT_GE(refused, 15U);
  viewer.stop();
}

}  // namespace
}  // namespace jalousie
