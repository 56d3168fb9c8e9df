// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/driver/opened_file.h"

#include "core/model/session/accounts.h"
#include "core/model/session/messages.h"
#include "core/model/session/roster.h"
#include "core/model/session/session.h"
#include "tests/app/gui/models/stage.h"

#include <QFile>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

namespace posewire::gui {
namespace {

/// A file that is several times as large as the log.
class FileImportTest : public testing::Test {
protected:
    static constexpr std::uint32_t kDatagrams = 40'000;

    void SetUp() override {
        QFile file(m_path);
        ASSERT_TRUE(file.open(QIODevice::WriteOnly));
        wire::Datagram datagram;
        datagram.body = smallPose();
        for (std::uint32_t sample = 1; sample <= kDatagrams; ++sample) {
            datagram.header.sampleCounter = sample;
            datagram.header.timeCode = 4 * sample;
            wire::completeHeader(datagram, wire::HeaderEra::Counted);
            const auto bytes = *wire::encode(datagram);
            file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<qint64>(bytes.size()));
        }
    }

    /// What is to be read anywhere, whatever the memory of the log holds.
    static void expectAllOf(model::Session& session) {
        ASSERT_EQ(session.end(), kDatagrams);
        EXPECT_EQ(session.begin(), 0U);
        const model::CharacterKey key = session.roster().characters().front().key;
        for (const std::uint64_t number : {0U, 39'999U, 1U, 20'000U, 7U, 35'000U}) {
            session.setCursor({model::Cursor::Mode::Paused, number});
            const model::Message* message = session.messages().message(key, 2);
            ASSERT_NE(message, nullptr) << number;
            EXPECT_EQ(message->packet, number);
            EXPECT_EQ(message->datagram.header.sampleCounter, number + 1);
            ASSERT_NE(session.accounts().digests().find(number), nullptr);
            EXPECT_EQ(session.accounts().digests().find(number)->type, 2);
        }
    }
    /// Follows until it is in the log.
    void follow(FileImport& import, log::PacketLog& log, model::Session& session) {
        while (!import.result()) {
            session.followFile(log.timeline().now(m_clock));
            import.follow(session.end());
        }
        session.followFile(log.timeline().now(m_clock));
    }

    log::SystemClock m_clock;
    QTemporaryDir m_folder;
    QString m_path = m_folder.filePath("long.bin");
    log::PacketLog m_log{{.memoryCap = 1, .chunkSize = std::size_t{1} << 20}};
    model::Session m_session{m_log};
};

TEST_F(FileImportTest, WaitsForItsReaderSoThatNothingIsOvertaken) {
    FileImport import(m_log, m_path, Stage::kStart);
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(30);
    while (!import.result() && std::chrono::steady_clock::now() < end) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2)); // much slower than a disk
        m_session.followFile(Stage::kStart, 1'000);
        import.follow(m_session.end());
    }
    ASSERT_TRUE(import.result());
    EXPECT_EQ(import.result()->value(), "");
    EXPECT_EQ(import.share(), 1);
    EXPECT_EQ(m_session.accounts().overtaken(), 0U);
    EXPECT_GT(m_session.begin(), 0U) << "the log is smaller than the file";
    EXPECT_EQ(m_session.roster().senders().front().datagrams, kDatagrams);
    EXPECT_EQ(m_session.roster().streams().front().accounting.counts().samples, kDatagrams);
}

TEST_F(FileImportTest, ReadsFromTheFileWhatMemoryHasDropped) {
    const auto scratch =
        std::make_shared<log::Scratch>(m_folder.path().toStdString(), std::uint64_t{1} << 30);
    if (!scratch->hasFile()) {
        GTEST_SKIP() << "no files without a name in " << m_folder.path().toStdString();
    }
    log::PacketLog log(m_log.history().limits(), scratch);
    model::Session session(log);
    FileImport import(log, m_path, Stage::kStart);
    follow(import, log, session);
    EXPECT_GT(log.figures().begin, 20'000U) << "the log is smaller than the file";
    expectAllOf(session);
    EXPECT_EQ(scratch->figures().heapBytes, 0U);
    EXPECT_LE(log.figures().memoryAllocated, log.figures().memoryCap);
}

TEST_F(FileImportTest, KeepsWhatFitsIntoMemoryWhereTheDiskIsFull) {
    const auto scratch = std::make_shared<log::Scratch>(m_folder.path().toStdString(), 0);
    if (!scratch->hasFile()) {
        GTEST_SKIP() << "no files without a name in " << m_folder.path().toStdString();
    }
    log::PacketLog log(m_log.history().limits(), scratch); // finds out when it needs some
    model::Session session(log);
    FileImport import(log, m_path, Stage::kStart);
    follow(import, log, session);
    EXPECT_EQ(session.roster().senders().front().datagrams, kDatagrams);
    EXPECT_EQ(session.accounts().overtaken(), 0U);
    EXPECT_GT(session.begin(), 20'000U);
    EXPECT_TRUE(session.packet(session.begin()));
    EXPECT_LT(scratch->figures().heapBytes, std::size_t{2} << 20);
}

TEST_F(FileImportTest, EndsAtOnceWhenNobodyWantsItAnyMore) {
    const auto begin = std::chrono::steady_clock::now();
    { const FileImport import(m_log, m_path, Stage::kStart); } // nobody ever follows
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
}

TEST_F(FileImportTest, SaysWhatItCannotRead) {
    FileImport import(m_log, m_folder.filePath("missing"), Stage::kStart);
    while (!import.result()) {
        std::this_thread::yield();
    }
    EXPECT_TRUE(import.result()->error().contains("no such file"));
}

} // namespace
} // namespace posewire::gui
