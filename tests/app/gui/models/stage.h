// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "app/gui/base/commands.h"
#include "app/gui/base/comparison.h"
#include "app/gui/base/program_view.h"
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

/// Carries out commands at once and remembers what was asked for.
class ImmediateCommands : public Commands {
public:
    explicit ImmediateCommands(model::Session& session) : m_session(session) {}

    void select(const model::Selection& selection) override {
        m_session.setSelection(selection);
        ++selections;
    }
    void selectRange(const model::RangeChoice& range) override { m_session.setRange(range); }
    void selectPacket(std::uint64_t number) override {
        model::Selection selection = m_session.selection();
        selection.packet = number;
        select(selection);
    }
    void goLive() override { m_session.setCursor({}); }
    void showMoment(log::Stamp moment) override {
        m_session.setCursor({model::Cursor::Mode::Paused, m_session.packetAt(moment)});
    }
    void setMarked(std::uint64_t packet, bool isMarked) override { m_session.setMarked(packet, isMarked); }
    void setComment(std::uint64_t packet, const QString& comment) override {
        m_session.setComment(packet, comment.toStdString());
    }
    void setOverride(log::SenderId sender, const model::SenderOverride& overrides) override {
        m_session.setOverride(sender, overrides);
    }
    void setDisplayFilter(const QString& filter) override {
        m_session.setDisplayFilter(filter.toStdString());
    }
    void jump(std::uint64_t packet, const QString& filter) override {
        model::Selection selection = m_session.selection();
        selection.packet = packet;
        m_session.jump(selection, filter.toStdString());
    }
    void goBack() override { m_session.goBack(); }
    void frameCharacter(const model::CharacterKey& key) override { framed.push_back(key); }
    void setLifted(const model::CharacterKey& key, bool isLifted) override {
        m_session.setLifted(key, isLifted);
    }
    void setCharacterVisible(const model::CharacterKey& key, bool isVisible) override {
        m_session.setHidden(key, !isVisible);
    }
    void forgetSender(log::SenderId sender) override { m_session.forget(sender); }
    void setGhostVisible(bool isVisible) override { m_session.setGhostShown(isVisible); }
    void showDock(const QString& name) override { shownDock = name; }
    void showIncident(std::optional<std::uint64_t> number, std::optional<model::CharacterKey> of) override {
        m_session.askForIncident(number, of);
    }
    void copyText(const QString& text) override { copied = text; }
    void askForComparison() override { ++comparisonsAskedFor; }
    void endComparison() override { comparison = {}; }
    void setComparison(const ComparisonChoice& choice) override { comparison = choice; }
    void setComparing(bool isOn) override { isComparing = isOn; }
    void saveComparison(const QString& path) override { comparisonFile = path; }

    int selections = 0;
    std::vector<model::CharacterKey> framed;
    QString copied;
    QString shownDock;
    int comparisonsAskedFor = 0;
    ComparisonChoice comparison;
    bool isComparing = true;
    QString comparisonFile;

private:
    model::Session& m_session;
};

/// A program that listens to nothing and costs nothing.
class IdleProgram : public ProgramView {
public:
    [[nodiscard]] ReceivingState receivingState() const override { return {}; }
    [[nodiscard]] MonitorHealth monitorHealth() const override { return {}; }
    [[nodiscard]] const ComparisonState& comparison() const override { return compared; }

    ComparisonState compared;
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
    ImmediateCommands commands{session};
    IdleProgram program;
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
