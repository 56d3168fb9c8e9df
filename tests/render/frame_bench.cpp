// SPDX-License-Identifier: MIT
// How long one frame of two characters with their axes takes at 1280 x 720, read back included, for each
// detail of the mannequin. Numbers mean something on an idle machine only.
#include "render/mesh/mannequin.h"
#include "render/offscreen.h"
#include "tests/render/poses.h"
#include "tests/support/baseline.h"

#include <array>

#include <benchmark/benchmark.h>

namespace posewire::render::testing {
namespace {

struct Stage {
    std::array<Pose, 2> poses;
    std::array<std::vector<DualQuaternion>, 2> palettes;
    std::array<SkinnedInstance, 2> characters;
    std::vector<AxesInstance> axes;
    Scene scene;
};

void fill(Stage& stage, MeshId mesh) {
    stage.poses = {placed(standingPose(), {-0.3F, -0.85F, 0.0F}, 0.35F),
                   placed(lungePose(), {0.1F, 0.75F, 0.0F})};
    for (std::size_t i = 0; i < 2; ++i) {
        stage.palettes[i] = paletteOf(stage.poses[i]);
        stage.characters[i].mesh = mesh;
        stage.characters[i].palette = stage.palettes[i];
        for (std::size_t segment = 0; segment < kSegmentCount; ++segment) {
            stage.axes.push_back(
                {stage.poses[i].positions[segment], stage.poses[i].orientations[segment], 0.12F});
        }
    }
    stage.scene.characters = stage.characters;
    stage.scene.axes = stage.axes;
    stage.scene.colours = darkSceneColours();
    stage.scene.camera.yaw = 0.25F;
    stage.scene.camera.distance = 5.6F;
    stage.scene.light = keyLight(stage.scene.camera);
}

void drawTwoCharacters(benchmark::State& state) {
    useSoftwareOpenGl();
    auto offscreen = OffscreenRenderer::create();
    if (!offscreen) {
        state.SkipWithError(offscreen.error().c_str());
        return;
    }
    const SkinnedMesh mesh = loadMannequin(static_cast<Detail>(state.range(0)));
    Stage stage;
    fill(stage, offscreen->renderer().uploadMesh(mesh, mesh.positions));
    for (auto _ : state) {
        stage.scene.camera.yaw += 0.001F;
        benchmark::DoNotOptimize(offscreen->render(stage.scene, 1280, 720).pixels.data());
    }
    state.SetLabel(std::to_string(mesh.triangleCount()) + " triangles, " +
                   offscreen->renderer().rendererName());
}

BENCHMARK(drawTwoCharacters)
    ->Arg(static_cast<int>(Detail::Medium))
    ->Arg(static_cast<int>(Detail::High))
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

} // namespace
} // namespace posewire::render::testing

BENCHMARK_MAIN();
