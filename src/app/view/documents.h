// Open files side by side: opening, loading, watching, closing, their places in the window, and shared cameras.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "app/render_cameras.h"
#include "app/view/document.h"
#include "app/view/file_watch.h"
#include "app/view/messages.h"
#include "app/view/redraw.h"
#include "app/view/region.h"
#include "app/view/view_options.h"
#include "app/view/view_state.h"
#include "gl/shader_source.h"

namespace jalousie::app {

/// All open files, in the order in which they were opened; the window's columns are shared equally among them.
class Documents {
 public:
  /// Opens the files of the options; loads nothing yet.
  /// @param options, state, redraw, messages  must outlive this
  Documents(const ViewOptions& options, ViewState& state, Redraw& redraw, Messages& messages);
  Documents(const Documents&) = delete;
  Documents& operator=(const Documents&) = delete;

  std::size_t size() const { return documents_.size(); }
  bool empty() const { return documents_.empty(); }
  Document& operator[](std::size_t index) { return *documents_[index]; }
  const Document& operator[](std::size_t index) const { return *documents_[index]; }
  /// The document that keys and panel act on; null if none is open.
  Document* current() { return state_.current < size() ? documents_[state_.current].get() : nullptr; }
  /// Index of the document whose region holds a point.
  std::optional<std::size_t> at(const glm::vec2& point) const;
  /// Index of an open document. @pre it is open (checked)
  std::size_t indexOf(const Document* document) const;

  /// Opens glTF and GLB files; a folder stands for those in it. Refuses more than eight with a message.
  void open(const std::vector<std::filesystem::path>& files);
  void closeCurrent();
  /// Whether some file was opened and not read yet.
  bool loading() const;
  /// Reads the first file that was not read yet. @return its index
  std::optional<std::size_t> loadNext();
  /// With --watch, reads changed files again; builds all programs anew when a shader changed. Looks every 0.25 s.
  void watch();
  /// A failure of configuration B does not count while B is not shown; B is tried again when it is shown.
  void forgetHiddenFailures();

  /// Size of the window's framebuffer in pixels.
  void setSize(std::uint32_t width, std::uint32_t height);
  std::uint32_t height() const { return height_; }
  /// Where a document's picture is in the window.
  Region region(std::size_t index) const;

  /// Options of the picture of one document under one configuration, with cameras and size. Finished.
  RenderOptions optionsFor(std::size_t index, int side) const;
  /// Cameras of such a picture; shows a message and returns nothing where the options give no usable camera.
  std::optional<RenderCameras> camerasFor(std::size_t index, int side);
  /// Drawing camera of configuration A, or one that sees the whole scene.
  scene::Camera drawCamera(std::size_t index);
  /// Indices of the documents that share the leader's camera, the leader included: with linked cameras, those whose
  /// scenes have about the size and place of the leader's.
  std::vector<std::size_t> followers(std::size_t leader) const;
  /// The current document and its followers get the cameras of the start.
  void resetCameras();

 private:
  void openOne(const std::filesystem::path& file);
  void readChangedFiles();
  void rebuildShaders();

  const ViewOptions& options_;
  ViewState& state_;
  Redraw& redraw_;
  Messages& messages_;
  std::vector<std::unique_ptr<Document>> documents_;
  gl::ShaderLibrary shaders_;
  FileWatch shaderWatch_;
  double lastWatch_ = 0.0;  ///< seconds
  std::uint32_t width_ = 0;
  std::uint32_t height_ = 0;
};

}  // namespace jalousie::app
