// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/takes.h"

#include "app/gui/driver/session_driver.h"
#include "core/log/output_file.h"
#include "core/log/recording_file.h"
#include "core/wire/codec.h"
#include "tests/support/manual_clock.h"

#include <QDir>
#include <QFile>
#include <QSignalSpy>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <thread>
#include <utility>
#include <vector>

namespace posewire::gui {
namespace {

using namespace std::chrono_literals;

/// A folder that is also the home of the user: a take whose own folder is gone continues there.
struct Place {
    Place() { qputenv("HOME", QFile::encodeName(folder.path())); }
    ~Place() { qputenv("HOME", before); }

    /// Removes each file of the take until the take ends by itself.
    void removeWhatIsRecorded(Takes& takes) const {
        for (int i = 0; i < 20'000 && takes.isRecording(); ++i) {
            QDir(folder.filePath("takes")).removeRecursively();
            QDir(folder.filePath("Documents")).removeRecursively();
            takes.follow(log::Stamp(1s));
            std::this_thread::sleep_for(1ms);
        }
    }

    const QByteArray before = qgetenv("HOME");
    const QTemporaryDir folder;
};

/// Takes of a log in which 100 packets are, and of a session that follows it.
class TakesTest : public testing::Test {
protected:
    void SetUp() override {
        const std::vector<std::byte> bytes(100, std::byte{7});
        const log::SenderId sender =
            m_origin.log().senders().intern({"10.0.0.2:5", log::Transport::Udp, 9763});
        for (int i = 0; i < 100; ++i) {
            m_origin.log().writer().append(bytes, {.stamp = log::Stamp(i * 1ms), .sender = sender});
        }
        m_origin.log().writer().publish();
        m_origin.session().follow(log::Stamp(1s));
    }
    void begin() {
        ASSERT_EQ(
            m_takes.toggle({.folder = m_folder, .pattern = "take", .preRollSeconds = 60, .freeMegabytes = 0}),
            "");
        ASSERT_TRUE(until([this] { return m_takes.state()->figures.packets == 100; }));
    }
    bool until(const std::function<bool()>& condition) {
        const auto end = std::chrono::steady_clock::now() + 10s;
        while (!condition() && std::chrono::steady_clock::now() < end) {
            m_takes.follow(log::Stamp(1s));
            std::this_thread::sleep_for(1ms);
        }
        return condition();
    }
    /// Of recordings.
    [[nodiscard]] std::vector<words::Kind> told() {
        std::vector<words::Kind> kinds;
        for (const model::Incident& one : m_origin.session().verdicts().incidents().all()) {
            if (one.kind == model::IncidentKind::RecordingEnded) {
                kinds.push_back(one.detail.kind);
            }
        }
        return kinds;
    }

    const Place m_place;
    const QString m_folder = m_place.folder.filePath("takes");
    model::Origin m_origin;
    Takes m_takes{m_origin};
    QSignalSpy m_changed{&m_takes, &Takes::changed};
    QSignalSpy m_recorded{&m_takes, &Takes::recorded};
};

TEST_F(TakesTest, AreCalledRecordedOnceTheyAreOnTheDisk) {
    begin();
    ASSERT_EQ(m_takes.toggle({}), "");
    EXPECT_EQ(m_recorded.count(), 0);
    ASSERT_TRUE(until([this] { return m_recorded.count() == 1; }));
    EXPECT_EQ(m_recorded[0][0].toString(), m_folder + "/take.pcapng");
    EXPECT_TRUE(told().empty());
    EXPECT_TRUE(m_takes.end());
}

TEST_F(TakesTest, GoOnInAnotherFileIfTheirOwnIsGone) {
    begin();
    ASSERT_TRUE(QDir(m_folder).removeRecursively());
    ASSERT_TRUE(until([this] { return !told().empty(); }));
    EXPECT_EQ(told(), std::vector{words::Kind::RecordingMoved});
    EXPECT_NE(m_changed.last()[0].toString(), "");
    ASSERT_EQ(m_takes.toggle({}), "");
    ASSERT_TRUE(until([this] { return m_recorded.count() == 1; }));
    EXPECT_EQ(m_recorded[0][0].toString(), m_folder + "/take part 2.pcapng");
    EXPECT_TRUE(QFile::exists(m_folder + "/take part 2.pcapng"));
    EXPECT_TRUE(m_takes.end());
}

TEST_F(TakesTest, AreNotOnTheDiskIfTheyEndedByThemselves) {
    begin();
    m_place.removeWhatIsRecorded(m_takes);
    ASSERT_FALSE(m_takes.isRecording());
    EXPECT_EQ(told().back(), words::Kind::RecordingEnded);
    EXPECT_EQ(m_recorded.count(), 0);
    EXPECT_FALSE(m_takes.end());
}

/// A whole run with a history, whose take is taken away meanwhile, or not.
void run(const Place& place, bool isTakenAway) {
    const QString folder = place.folder.path();
    const log::SystemClock clock;
    SessionDriver driver(clock, folder);
    EXPECT_EQ(driver.history().keep(std::uint64_t{64} << 20), "");
    EXPECT_EQ(driver.takes().toggle({.folder = folder + "/takes", .freeMegabytes = 0}), "");
    if (isTakenAway) {
        place.removeWhatIsRecorded(driver.takes());
    }
    EXPECT_NE(driver.takes().isRecording(), isTakenAway);
}

TEST(TakesAtTheEnd, LeaveTheHistoryIfTheyAreNotOnTheDisk) {
    for (const bool isTakenAway : {false, true}) {
        const Place place;
        run(place, isTakenAway);
        const QStringList files = QDir(place.folder.path()).entryList({"history-*.pcapng"}, QDir::Files);
        EXPECT_EQ(files.size(), isTakenAway ? 1 : 0);
    }
}

/// The records of a take.
std::vector<std::pair<std::vector<std::byte>, bool>> packetsIn(const QString& path) {
    std::vector<std::pair<std::vector<std::byte>, bool>> packets;
    auto source = log::openFile(QFile::encodeName(path).toStdString());
    static_cast<void>(log::readFile(**source, [&packets](const log::FileRecord& record) {
        packets.emplace_back(std::vector(record.bytes.begin(), record.bytes.end()),
                             record.flags.isFromBefore);
    }));
    return packets;
}

TEST_F(TakesTest, BeginWithTheNewestBodyAndNameFromBefore) {
    const auto sent = [&](wire::Body body, std::uint8_t counter = 0x80) {
        wire::Datagram datagram;
        datagram.body = std::move(body);
        datagram.header.datagramCounter = counter;
        wire::completeHeader(datagram, wire::HeaderEra::Counted);
        auto bytes = wire::encode(datagram).value();
        m_origin.log().writer().append(bytes, {.stamp = log::Stamp(1s), .sender = log::SenderId{}});
        m_origin.log().writer().publish();
        return bytes;
    };
    const auto named = [](const char* name) {
        wire::MetaData metadata;
        metadata.text = std::string("name:") + name + '\n';
        return metadata;
    };
    sent(named("Anna"));
    const auto first = sent(named("Bert"), 0x00);
    const auto second = sent(named("Bert"), 0x81);
    sent(named("Carl"), 0x00); // its second part has not come yet
    for (int i = 0; i < 3; ++i) {
        sent(wire::PoseQuaternion{});
    }
    m_origin.session().follow(log::Stamp(1s));
    m_origin.session().setCursor({.mode = model::Cursor::Mode::Paused, .packet = 0}); // no matter
    ASSERT_EQ(m_takes.toggle({.folder = m_folder, .pattern = "take", .freeMegabytes = 0}), "");
    const auto after = sent(wire::PoseQuaternion{});
    ASSERT_TRUE(until([this] { return m_takes.state()->figures.packets == 3; }));
    ASSERT_TRUE(m_takes.end());
    const auto packets = packetsIn(m_folder + "/take.pcapng");
    ASSERT_EQ(packets.size(), 3U);
    EXPECT_EQ(packets[0], std::pair(first, true));
    EXPECT_EQ(packets[1], std::pair(second, true));
    EXPECT_EQ(packets[2], std::pair(after, false));
}

} // namespace
} // namespace posewire::gui
