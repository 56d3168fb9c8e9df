// SPDX-License-Identifier: MIT
#pragma once

#include "core/export/motion/motion_export.h"
#include "core/model/accounting/stream_figures.h"
#include "core/model/session/roster.h"
#include "core/model/session/session.h"
#include "core/performer/performer.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace posewire::exporting {

using namespace std::chrono_literals;

/// Performers whose datagrams are recorded, and files of what is exported of that.
class MotionTest : public testing::Test {
protected:
    static constexpr log::Stamp kStart{1'700'000'000s};

    ~MotionTest() override { std::filesystem::remove_all(m_folder); }

    using Sends = std::function<bool(const wire::Datagram&)>;
    static bool sendsAll(const wire::Datagram&) { return true; }

    /// Frames from 0 on, one after the other at the rate of the settings, each stamped when it is due.
    void perform(const performer::PerformerSettings& settings, std::uint64_t frames,
                 const Sends& sends = sendsAll, log::Stamp from = kStart,
                 const std::string& address = "127.0.0.1:40001") {
        performer::Performer performer(settings);
        for (std::uint64_t frame = 0; frame < frames; ++frame) {
            const log::Stamp stamp = from + log::durationOf(static_cast<double>(frame) / settings.rateHz);
            for (const wire::Datagram& datagram : performer.frame(frame)) {
                if (sends(datagram)) {
                    send(datagram, stamp, address);
                }
                note(datagram);
            }
        }
        follow();
    }

    void send(const wire::Datagram& datagram, log::Stamp stamp,
              const std::string& address = "127.0.0.1:40001") {
        log::Arrival arrival;
        arrival.stamp = m_newest = std::max(m_newest, stamp);
        arrival.sender = m_log.senders().intern({address, log::Transport::Udp, 9763});
        m_log.writer().append(wire::encode(datagram).value(), arrival);
    }

    void follow() {
        m_log.writer().publish();
        while (m_session.followFile(m_newest)) {
        }
    }

    [[nodiscard]] feed::PoseSource source(const model::TimeRange& range = model::kAllTime) const {
        std::vector<model::CharacterKey> keys;
        for (const model::Character* one : m_session.atNow().roster().listed()) {
            keys.push_back(one->key);
        }
        return feed::poseSourceOf(m_session, range, keys);
    }

    /// All frames of one character.
    struct Frame {
        MotionFrame frame;
        model::CharacterPose pose; ///< as it was
    };
    [[nodiscard]] static std::vector<Frame>
    framesOf(const feed::PoseSource& source, std::size_t character = 0,
             feed::PoseContent content = feed::PoseContent::Segments) {
        const auto survey = surveyMotion(source, content, {});
        std::vector<Frame> frames;
        const auto read = readMotion(
            source, content, *survey,
            [&](const MotionFrame& frame) {
                if (frame.character == character) {
                    frames.push_back({frame, frame.isGap() ? model::CharacterPose() : *frame.pose});
                }
            },
            {});
        EXPECT_TRUE(read);
        EXPECT_EQ(frames.size(), survey->characters[character].frames);
        return frames;
    }

    /// What came of writing all there is as a format; the files are in the folder.
    [[nodiscard]] tl::expected<std::vector<ExportedMotion>, log::FileError>
    write(const std::string& suffix, const feed::PoseSource& from,
          const ExportProgress& progress = {}) const {
        const MotionFormat* format = findMotionFormat(suffix);
        return exportMotion({from, *format, path("take." + suffix), {}, "Posewire test"}, progress);
    }
    /// The one file that came of it.
    [[nodiscard]] std::string written(const std::string& suffix, const feed::PoseSource& from) const {
        const auto exported = write(suffix, from);
        EXPECT_TRUE(exported) << exported.error().text;
        return exported && !exported->empty() ? textOf(exported->front().path) : std::string();
    }

    [[nodiscard]] std::string path(const std::string& name) const { return (m_folder / name).string(); }
    static std::string textOf(const std::string& path) {
        std::ostringstream text;
        text << std::ifstream(path, std::ios::binary).rdbuf();
        return text.str();
    }
    [[nodiscard]] std::vector<std::string> filesLeft() const {
        std::vector<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(m_folder)) {
            names.push_back(entry.path().filename().string());
        }
        std::ranges::sort(names);
        return names;
    }

    /// What was sent of a character as type 02, lost or not.
    [[nodiscard]] const std::vector<model::SegmentPose>& sent(std::uint8_t character,
                                                              std::uint32_t sample) const {
        return m_sent.at({character, sample});
    }

    static performer::PerformerSettings settings(int characters = 1, double rateHz = 60) {
        performer::PerformerSettings settings;
        settings.characters = characters;
        settings.rateHz = rateHz;
        settings.types = {2, 12, 13};
        return settings;
    }

    log::PacketLog m_log;
    model::Session m_session{m_log};
    std::filesystem::path m_folder = test::newTemporaryFolder("motion");

private:
    void note(const wire::Datagram& datagram) {
        if (const auto* message = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            std::vector<model::SegmentPose>& poses =
                m_sent[{datagram.header.character, datagram.header.sampleCounter}];
            poses.clear();
            for (const wire::SegmentQuaternion& item : message->segments) {
                poses.push_back(model::poseFromQuaternion(item));
            }
        }
    }

    std::map<std::pair<std::uint8_t, std::uint32_t>, std::vector<model::SegmentPose>> m_sent;
    log::Stamp m_newest{};
};

/// Lets no datagram with these samples through.
inline auto without(std::vector<std::uint32_t> samples) {
    return [samples = std::move(samples)](const wire::Datagram& datagram) {
        return std::ranges::find(samples, datagram.header.sampleCounter) == samples.end();
    };
}

/// Largest difference of a component; 1 where one has more segments.
inline double differenceOf(const std::vector<model::SegmentPose>& a,
                           const std::vector<model::SegmentPose>& b) {
    double most = a.size() == b.size() ? 0 : 1;
    for (std::size_t i = 0; most < 1 && i < a.size(); ++i) {
        most = std::max({most, (a[i].position - b[i].position).cwiseAbs().maxCoeff(),
                         (a[i].orientation.coeffs() - b[i].orientation.coeffs()).cwiseAbs().maxCoeff()});
    }
    return most;
}

} // namespace posewire::exporting
