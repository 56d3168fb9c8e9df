// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/viewport/scene.h"
#include "core/log/packet_log.h"
#include "core/model/session/session.h"
#include "core/performer/performer.h"
#include "render/offscreen.h"
#include "tests/support/baseline.h"

#include <gtest/gtest.h>

#include <optional>
#include <span>
#include <vector>

namespace posewire::gui {

/// Datagrams in, picture out: the whole path but for the socket.
class FigureStudio : public testing::Test {
protected:
    void SetUp() override {
        render::test::useSoftwareOpenGl();
        auto created = render::OffscreenRenderer::create();
        ASSERT_TRUE(created.has_value()) << created.error();
        m_offscreen.emplace(std::move(*created));
    }

    void send(std::span<const std::byte> bytes, log::Stamp stamp = {}) {
        log::Arrival arrival;
        arrival.stamp = stamp;
        arrival.sender = m_log.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
        m_log.writer().append(bytes, arrival);
        m_log.writer().publish();
        m_session.follow(stamp);
    }

    /// One frame of a performer, as received at its own rate.
    void perform(performer::Performer& performer, std::uint64_t frame) {
        const double seconds = static_cast<double>(frame) / performer.settings().rateHz;
        for (const wire::Datagram& datagram : performer.frame(frame)) {
            const auto bytes = wire::encode(datagram);
            ASSERT_TRUE(bytes.has_value());
            send(*bytes, log::Stamp(log::durationOf(seconds)));
        }
    }

    static performer::Performer walker(std::vector<std::uint8_t> types) {
        performer::PerformerSettings settings;
        settings.characters = 1;
        settings.seed = 7;
        settings.types = std::move(types);
        return performer::Performer(settings);
    }

    /// Looks at the first figure, by default from its front left.
    SceneFrame frameOf(AxesMode axes, const Overlays& overlays, float yaw = 0.9F) {
        SceneBuilder builder(m_session, render::Detail::High);
        SceneFrame frame;
        builder.build(axes, overlays, frame);
        if (!frame.figures.empty()) {
            frame.camera.target = frame.figures.front().bounds.centre();
        }
        frame.camera.yaw = yaw;
        frame.camera.pitch = 0.15F;
        frame.camera.distance = 4.8F;
        return frame;
    }

    const render::Image& shoot(SceneFrame frame, int width, int height) {
        m_frame = std::move(frame);
        m_frame.width = width;
        m_frame.height = height;
        sizeAxes(m_frame);
        return m_offscreen->render(m_upload.prepare(m_frame, m_offscreen->renderer()), width, height);
    }

    log::PacketLog m_log;
    model::Session m_session{m_log};

private:
    std::optional<render::OffscreenRenderer> m_offscreen;
    SceneUpload m_upload;
    SceneFrame m_frame;
};

} // namespace posewire::gui
