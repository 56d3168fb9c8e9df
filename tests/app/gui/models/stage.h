// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/playback.h"
#include "core/log/packet_log.h"
#include "core/log/time.h"
#include "core/model/body/character_pose.h"
#include "core/model/session/session.h"
#include "core/performer/performer.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>

namespace posewire::gui {

using namespace std::chrono_literals;

/// What was asked of the window.
struct Asked {
    explicit Asked(Commands& commands) {
        QObject::connect(&commands, &Commands::changed, &commands, [this] { ++count; });
        QObject::connect(&commands, &Commands::showDock, &commands, [this](auto& name) { dock = name; });
        QObject::connect(&commands, &Commands::frameCharacter, &commands,
                         [this](auto& key) { framed.push_back(key); });
    }

    int count = 0; ///< commands that were carried out
    QString dock;
    std::vector<model::CharacterKey> framed;
};

/// A log to which tests send datagrams at stamps of their choosing, and a session that follows it.
struct Stage {
    static constexpr log::Stamp kStart{1'700'000'000s};
    static constexpr const char* kAddress = "192.168.10.21:52011";

    log::SenderId sender(const std::string& address = kAddress) {
        return log.senders().intern({address, log::Transport::Udp, 9763});
    }
    model::CharacterKey key(std::uint8_t character = 0) { return {sender(), character}; }

    void sendBytes(wire::Bytes bytes, log::Stamp stamp, const std::string& address = kAddress) {
        log::Arrival arrival;
        arrival.stamp = stamp;
        arrival.sender = sender(address);
        log.writer().append(bytes, arrival);
        log.writer().publish();
        now = std::max(now, stamp);
    }

    void send(const wire::Datagram& datagram, log::Stamp stamp, const std::string& address = kAddress) {
        const auto bytes = wire::encode(datagram);
        ASSERT_TRUE(bytes.has_value());
        sendBytes(*bytes, stamp, address);
    }

    /// One message of its own; `timeCode` in ms.
    void send(wire::Body body, std::uint32_t sample, std::uint32_t timeCode, log::Stamp stamp,
              std::uint8_t datagramCounter = 0x80) {
        wire::Datagram datagram;
        datagram.body = std::move(body);
        datagram.header.sampleCounter = sample;
        datagram.header.timeCode = timeCode;
        datagram.header.datagramCounter = datagramCounter;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        send(datagram, stamp);
    }

    void sendMetadata(const std::string& text, log::Stamp stamp) {
        wire::MetaData metadata;
        metadata.text = text;
        send(metadata, 0, 0, stamp);
    }

    /// Frames [from, to) of a performer at its own rate; `isSent` may leave frames out.
    void perform(performer::Performer& performer, std::uint64_t from, std::uint64_t to,
                 const std::function<bool(std::uint64_t)>& isSent = {}) {
        for (std::uint64_t frame = from; frame < to; ++frame) {
            if (isSent && !isSent(frame)) {
                continue;
            }
            const double seconds = static_cast<double>(frame) / performer.settings().rateHz;
            for (const wire::Datagram& datagram : performer.frame(frame)) {
                send(datagram, kStart + log::durationOf(seconds));
            }
        }
    }

    void follow() { session.follow(now); }

    log::PacketLog log{{.memoryCap = std::size_t{64} << 20, .chunkSize = std::size_t{1} << 20}};
    model::Session session{log};
    Commands commands{session};
    Asked asked{commands};
    log::SystemClock clock;
    Playback playback{commands, clock};
    log::Stamp now = kStart;
};

/// Settings of a sender; no types means all.
inline performer::PerformerSettings sending(int characters, std::vector<std::uint8_t> types = {},
                                            double rateHz = 240.0) {
    performer::PerformerSettings settings;
    settings.characters = characters;
    settings.types = std::move(types);
    settings.rateHz = rateHz;
    return settings;
}

/// A pose with one segment, for tests that want a stream and not its content.
inline wire::PoseQuaternion smallPose() {
    wire::PoseQuaternion pose;
    pose.segments.push_back({1, {0, 0, 1}, {1, 0, 0, 0}});
    return pose;
}

} // namespace posewire::gui
