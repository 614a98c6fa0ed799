// Dear ImGui in a window: context, font, style, backends.
#include "app/view/interface.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise brings the system's own OpenGL header.
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "core/error.h"

namespace jalousie::app {
namespace {

constexpr float kFontPixels = 15.0F;
constexpr const char* kFonts[] = {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf",
                                  "/usr/share/fonts/TTF/DejaVuSans.ttf"};

float displayScale(GLFWwindow* window) {
  float x = 1.0F;
  float y = 1.0F;
  glfwGetWindowContentScale(window, &x, &y);
  return std::clamp(std::max(x, y), 0.5F, 8.0F);
}

void loadFont(float scale) {
  ImGuiIO& io = ImGui::GetIO();
  io.Fonts->Clear();
  for (const char* font : kFonts)
    if (std::error_code failed;
        std::filesystem::exists(font, failed) && io.Fonts->AddFontFromFileTTF(font, kFontPixels * scale) != nullptr)
      return;
  ImFontConfig config;
  config.SizePixels = 13.0F * scale;
  io.Fonts->AddFontDefault(&config);
}

void style(float scale) {
  ImGuiStyle& s = ImGui::GetStyle();
  s = ImGuiStyle();
  ImGui::StyleColorsDark();
  s.WindowRounding = 5.0F;
  s.FrameRounding = 3.0F;
  s.GrabRounding = 3.0F;
  s.WindowBorderSize = 0.0F;
  s.Colors[ImGuiCol_WindowBg] = ImVec4(0.085F, 0.095F, 0.11F, 0.94F);
  s.Colors[ImGuiCol_TitleBgActive] = ImVec4(0.16F, 0.29F, 0.44F, 1.0F);
  s.ScaleAllSizes(scale);
}

/// The positions and sizes of windows in a text of Dear ImGui's format. Everything else is removed, because the text is
/// untrusted input and the library's parser does not check it.
std::string windowPlaces(const std::string& text) {
  std::string places;
  std::istringstream lines(text);
  bool inside = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) inside = line.starts_with("[Window][") && line.ends_with("]");
    const bool place = line.starts_with("Pos=") || line.starts_with("Size=") || line.starts_with("Collapsed=");
    if (inside && (place || line.starts_with("["))) places += line + "\n";
  }
  return places;
}

/// Converts from screen coordinates to pixels where these differ, because overlays are drawn in the pixels of pictures.
void usePixels() {
  ImGuiIO& io = ImGui::GetIO();
  const ImVec2 pixels = io.DisplayFramebufferScale;
  if (pixels.x <= 0.0F || pixels.y <= 0.0F) return;
  io.DisplaySize = {io.DisplaySize.x * pixels.x, io.DisplaySize.y * pixels.y};
  io.DisplayFramebufferScale = {1.0F, 1.0F};
  if (ImGui::IsMousePosValid(&io.MousePos)) io.MousePos = {io.MousePos.x * pixels.x, io.MousePos.y * pixels.y};
}

}  // namespace

Interface::Interface(GLFWwindow* window, float scale, const std::string& layout)
    : window_(window), followsDisplay_(scale <= 0.0F) {
  IMGUI_CHECKVERSION();
  ImGui::CreateContext();
  ImGuiIO& io = ImGui::GetIO();
  io.IniFilename = nullptr;
  io.LogFilename = nullptr;
  const std::string places = windowPlaces(layout);
  if (!places.empty()) ImGui::LoadIniSettingsFromMemory(places.c_str(), places.size());
  if (!ImGui_ImplGlfw_InitForOpenGL(window, true) || !ImGui_ImplOpenGL3_Init("#version 450 core"))
    throw Error(ErrorCode::kShader, "the interface cannot be drawn with this OpenGL");
  useScale(followsDisplay_ ? displayScale(window) : scale);
}

void Interface::useScale(float scale) {
  if (scale == scale_) return;
  scale_ = scale;
  loadFont(scale);
  style(scale);
  // The backend creates the texture of the font together with its other objects, in the next frame.
  ImGui_ImplOpenGL3_DestroyDeviceObjects();
}

Interface::~Interface() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
}

void Interface::begin() {
  if (followsDisplay_) useScale(displayScale(window_));
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  usePixels();
  ImGui::NewFrame();
}

void Interface::end() {
  ImGui::Render();
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

bool Interface::wantsPointer() const {
  return ImGui::GetIO().WantCaptureMouse;
}

bool Interface::wantsKeys() const {
  return ImGui::GetIO().WantTextInput;
}

std::string Interface::layout() const {
  std::size_t size = 0;
  const char* text = ImGui::SaveIniSettingsToMemory(&size);
  return windowPlaces({text, size});
}

}  // namespace jalousie::app
