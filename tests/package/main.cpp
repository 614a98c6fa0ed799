// A program outside the project: builds a scene with the installed library and renders one frame.
#include <core/error.h>
#include <platform/headless_context.h>
#include <render/frame_renderer.h>
#include <scene/camera.h>
#include <scene/scene_data.h>

#include <cstdio>

int main() {
  jalousie::asset::SceneFile file;
  file.materials.emplace_back();
  jalousie::asset::Primitive triangle;
  triangle.positions = {{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  triangle.normals.assign(3, {0, 0, 1});
  triangle.uvs.resize(3);
  triangle.colors.assign(3, glm::vec4(1.0F));
  triangle.indices = {0, 1, 2};
  file.meshes.push_back({"triangle", {triangle}});
  file.chains.push_back({"triangle", {{0, 0.0F}}});
  file.instances.push_back({0, glm::mat4(1.0F)});
  const jalousie::scene::SceneData scene = jalousie::scene::buildScene(file);
  try {
    const jalousie::platform::HeadlessContext context(false);
    jalousie::render::FrameRenderer renderer(scene, 64, 64);
    const jalousie::scene::Camera camera = jalousie::scene::frameBox(scene.boundsWorld, 1.0F);
    renderer.render({}, camera, camera);
    return renderer.readStatistics().triangles == 1 ? 0 : 1;
  } catch (const jalousie::Error& error) {
    std::printf("%s\n", error.what());
    return error.code() == jalousie::ErrorCode::kNoGpu ? 0 : 1;
  }
}
