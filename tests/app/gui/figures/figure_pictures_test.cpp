// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/app/gui/figures/figure_studio.h"
#include "tests/support/paths.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace posewire::gui {
namespace {

namespace fs = std::filesystem;

class FigurePictures : public FigureStudio {
protected:
    const render::Image& shootLight(AxesMode axes, float yaw) {
        SceneFrame frame = frameOf(axes, {}, yaw);
        frame.colours = render::lightSceneColours();
        return shoot(std::move(frame), 640, 480);
    }
};

TEST_F(FigurePictures, AWalkerPutsTheFootDown) {
    performer::Performer performer = walker({2, 12, 13});
    perform(performer, 0);
    perform(performer, 480);
    render::test::expectMatchesBaseline(shootLight(AxesMode::None, 0.9F), "walk_1");
}

TEST_F(FigurePictures, AWalkerHalfAStepLater) {
    performer::Performer performer = walker({2, 12, 13});
    perform(performer, 0);
    perform(performer, 545);
    render::test::expectMatchesBaseline(shootLight(AxesMode::All, 0.9F), "walk_2_axes");
}

TEST_F(FigurePictures, ARealPersonInTheCapturedPose) {
    const fs::path folder = posewire::test::capturesFolder();
    if (!fs::exists(folder / "mxtp02.bin")) {
        GTEST_SKIP() << "no recorded datagrams at " << folder << ": the captured pose is not tested";
    }
    for (const char* name : {"mxtp12.bin", "mxtp13.bin", "mxtp02.bin"}) {
        std::ifstream file(folder / name, std::ios::binary);
        const std::vector<char> content{std::istreambuf_iterator<char>(file), {}};
        send(std::as_bytes(std::span(content)));
    }
    render::test::expectMatchesBaseline(shootLight(AxesMode::All, 0.0F), "captured_pose");
}

} // namespace
} // namespace posewire::gui
