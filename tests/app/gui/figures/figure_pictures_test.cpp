// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/viewport/scene.h"
#include "core/log/packet_log.h"
#include "core/model/session/session.h"
#include "core/performer/performer.h"
#include "render/offscreen.h"
#include "tests/support/baseline.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

namespace posewire::gui {
namespace {

namespace fs = std::filesystem;

/// Datagrams in, picture out: the whole path but for the socket.
class FigurePictures : public testing::Test {
protected:
    void SetUp() override {
        render::testing::useSoftwareOpenGl();
        auto created = render::OffscreenRenderer::create();
        ASSERT_TRUE(created.has_value()) << created.error();
        m_offscreen.emplace(std::move(*created));
    }

    void send(std::span<const std::byte> bytes) {
        log::Arrival arrival;
        arrival.sender = m_log.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
        m_log.writer().append(bytes, arrival);
        m_log.writer().publish();
        m_session.follow(log::Stamp());
    }

    void perform(performer::Performer& performer, std::uint64_t frame) {
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            const auto bytes = wire::encode(datagram);
            ASSERT_TRUE(bytes.has_value());
            send(*bytes);
        }
    }

    /// Looks at the first figure from the front left.
    const render::Image& shoot(AxesMode axes, float yaw) {
        SceneBuilder builder(m_session, render::Detail::High);
        m_frame = {};
        builder.build(axes, {}, m_frame);
        m_frame.colours = render::lightSceneColours();
        if (!m_frame.figures.empty()) {
            m_frame.camera.target = m_frame.figures.front().bounds.centre();
        }
        m_frame.camera.yaw = yaw;
        m_frame.camera.pitch = 0.15F;
        m_frame.camera.distance = 4.8F;
        m_frame.width = 640;
        m_frame.height = 480;
        sizeAxes(m_frame);
        return m_offscreen->render(m_upload.prepare(m_frame, m_offscreen->renderer()), 640, 480);
    }

    log::PacketLog m_log;
    model::Session m_session{m_log};
    std::optional<render::OffscreenRenderer> m_offscreen;
    SceneUpload m_upload;
    SceneFrame m_frame;
};

performer::Performer oneWalker() {
    performer::PerformerSettings settings;
    settings.characters = 1;
    settings.seed = 7;
    settings.types = {2, 12, 13};
    return performer::Performer(settings);
}

TEST_F(FigurePictures, AWalkerPutsTheFootDown) {
    performer::Performer performer = oneWalker();
    perform(performer, 0);
    perform(performer, 480);
    render::testing::expectMatchesBaseline(shoot(AxesMode::None, 0.9F), "walk_1");
}

TEST_F(FigurePictures, AWalkerHalfAStepLater) {
    performer::Performer performer = oneWalker();
    perform(performer, 0);
    perform(performer, 545);
    render::testing::expectMatchesBaseline(shoot(AxesMode::All, 0.9F), "walk_2_axes");
}

TEST_F(FigurePictures, ARealPersonInTheCapturedPose) {
    const fs::path folder = test::capturesFolder();
    if (!fs::exists(folder / "mxtp02.bin")) {
        GTEST_SKIP() << "no recorded datagrams at " << folder << ": the captured pose is not tested";
    }
    for (const char* name : {"mxtp12.bin", "mxtp13.bin", "mxtp02.bin"}) {
        std::ifstream file(folder / name, std::ios::binary);
        const std::vector<char> content{std::istreambuf_iterator<char>(file), {}};
        send(std::as_bytes(std::span(content)));
    }
    render::testing::expectMatchesBaseline(shoot(AxesMode::All, 0.0F), "captured_pose");
}

} // namespace
} // namespace posewire::gui
