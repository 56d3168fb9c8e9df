// SPDX-License-Identifier: MIT
#include "core/log/file_names.h"
#include "core/log/recording.h"

#include "tests/core/log/log_fixture.h"
#include "tests/core/log/recording_fixture.h"
#include "tests/support/stream_source.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#ifndef _WIN32
#include <csignal>
#include <sys/resource.h>
#endif

namespace posewire::log {
namespace {

/// Names of files in a folder that goes away with the process.
std::string newFile() {
    struct Folder {
        std::filesystem::path path = test::newTemporaryFolder("recording");
        ~Folder() { std::filesystem::remove_all(path); }
    };
    static const Folder folder;
    static int number = 0;
    return (folder.path / ("recording_" + std::to_string(++number) + ".pcapng")).string();
}

std::vector<Recorded> recordedInFile(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return recordedIn(std::as_bytes(std::span(text)));
}

/// What counts at the end.
std::vector<std::string> notesIn(ByteSource& source) {
    std::vector<std::string> notes;
    static_cast<void>(readFile(source, {[](const FileRecord&) {}},
                               [&notes](auto told) { notes.assign(told.begin(), told.end()); }));
    return notes;
}

std::vector<std::string> notesIn(const std::string& path) {
    return notesIn(**openFile(path));
}

/// Each sample is a packet; its stamp is its number.
void append(PacketLog& log, std::uint32_t begin, std::uint32_t end) {
    const SenderId sender = log.senders().intern({"10.0.0.2:40001", Transport::Udp, 9763});
    for (std::uint32_t sample = begin; sample < end; ++sample) {
        log.writer().append(poseDatagram(sample), {Stamp(Duration(sample)), sender, 0, {}});
    }
    log.writer().publish();
}

template <class Condition>
bool waitFor(const Condition& condition) {
    for (int turn = 0; turn < 1000 && !condition(); ++turn) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return condition();
}

TEST(Recording, HoldsEveryPacketThatWasWrittenMeanwhile) {
    constexpr std::uint32_t count = 20'000;
    PacketLog log;
    const std::string path = newFile();
    auto recording = Recording::start(log, path, {});
    ASSERT_TRUE(recording) << recording.error().text;
    const SenderId sender = log.senders().intern({"10.0.0.2:40001", Transport::Udp, 9763});
    for (std::uint32_t sample = 0; sample < count; ++sample) {
        log.writer().append(poseDatagram(sample, 1), {Stamp(Duration(sample)), sender, 0, {}});
        log.writer().publish();
    }
    ASSERT_TRUE((*recording)->stop());
    EXPECT_EQ((*recording)->figures().packets, count);
    EXPECT_EQ((*recording)->figures().bytes, std::filesystem::file_size(path));
    EXPECT_EQ((*recording)->figures().missed, 0U);
    const auto seen = recordedInFile(path);
    ASSERT_EQ(seen.size(), count);
    for (std::uint32_t sample = 0; sample < count; ++sample) {
        ASSERT_EQ(seen[sample].bytes, poseDatagram(sample, 1));
        ASSERT_EQ(seen[sample].stamp, Stamp(Duration(sample)));
    }
}

TEST(Recording, EndsItsFileWhenItIsDestroyed) {
    PacketLog log;
    const std::string path = newFile();
    {
        const auto recording = Recording::start(log, path, {});
        ASSERT_TRUE(recording);
        append(log, 0, 3);
        (*recording)->setMarks({{2, "", "here"}});
    }
    EXPECT_EQ(recordedInFile(path).size(), 3U);
    EXPECT_THAT(notesIn(path), testing::ElementsAre("Mark on packet 2: here"));
}

TEST(Recording, GoesOnInAnotherFileWithoutLosingAPacket) {
    constexpr std::uint32_t count = 5'000;
    PacketLog log;
    const std::string path = newFile();
    auto recording = Recording::start(log, path, {}, {}, 0, {.fileBytes = 100'000});
    ASSERT_TRUE(recording) << recording.error().text;
    const SenderId sender = log.senders().intern({"10.0.0.2:40001", Transport::Udp, 9763});
    const auto hasFiles = [&](unsigned files) { return (*recording)->figures().files >= files; };
    std::uint32_t sample = 0;
    for (unsigned files = 2; files <= 3; ++files) { // until that many have begun
        for (; !hasFiles(files); ++sample) {
            log.writer().append(poseDatagram(sample), {Stamp(Duration(sample)), sender, 0, {}});
            log.writer().publish();
            if (sample >= count) {
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            }
        }
    }
    ASSERT_TRUE((*recording)->stop());
    std::uint32_t next = 0;
    std::uint64_t bytes = 0;
    for (unsigned part = 1; part <= (*recording)->figures().files; ++part) {
        bytes += std::filesystem::file_size(partPath(path, part));
        for (const Recorded& each : recordedInFile(partPath(path, part))) {
            ASSERT_EQ(each.stamp, Stamp(Duration(next++)));
        }
    }
    EXPECT_EQ(next, sample);
    EXPECT_EQ((*recording)->figures().packets, sample);
    EXPECT_EQ((*recording)->figures().bytes, bytes);
}

TEST(Recording, GoesOnUnderTheNextNameThatIsFree) {
    PacketLog log;
    const std::string path = newFile();
    const std::string taken = partPath(path, 2);
    std::ofstream(pathOf(taken)) << "of somebody else";
    const auto recording = Recording::start(log, path, {}, {}, 0, {.fileBytes = 10'000});
    ASSERT_TRUE(recording) << recording.error().text;
    append(log, 0, 100);
    ASSERT_TRUE(waitFor([&] { return (*recording)->figures().files == 2 || (*recording)->failure(); }));
    append(log, 100, 103);
    const auto stopped = (*recording)->stop();
    ASSERT_TRUE(stopped) << stopped.error().text;
    EXPECT_EQ(std::filesystem::file_size(taken), 16U);
    EXPECT_EQ(recordedInFile(path).size(), 100U);
    EXPECT_EQ(recordedInFile(partPath(path, 3)).size(), 3U);
    EXPECT_EQ((*recording)->figures().files, 2U);
}

TEST(Recording, EndsItsFileWhereItCannotGoOnInAnother) {
    PacketLog log;
    const std::string folder = newFile();
    const std::string moved = newFile();
    std::filesystem::create_directory(folder);
    const auto recording = Recording::start(log, folder + "/take", {});
    ASSERT_TRUE(recording) << recording.error().text;
    append(log, 0, 100);
    ASSERT_TRUE(waitFor([&] { return (*recording)->figures().packets == 100; }));
    (*recording)->setMarks({{7, "", ""}});
    std::filesystem::rename(folder, moved);
    std::ofstream(pathOf(folder)) << "a file";
    ASSERT_TRUE(waitFor([&] { return (*recording)->failure().has_value(); }));
    EXPECT_THAT((*recording)->failure()->text, testing::HasSubstr("moved while it was being written; "));
    EXPECT_THAT((*recording)->failure()->text, testing::HasSubstr("take part 2: cannot be written"));
    EXPECT_TRUE((*recording)->figures().displaced.empty());
    EXPECT_FALSE((*recording)->stop());
    EXPECT_EQ(recordedInFile(moved + "/take").size(), 100U);
    EXPECT_THAT(notesIn(moved + "/take"), testing::ElementsAre("Mark on packet 7"));
}

/// A recording of 100 packets in a folder of its own, of which its file is taken away.
class DisplacedRecording : public testing::Test {
protected:
    void begin(const RecordingLimits& limits = {}) {
        std::filesystem::create_directory(m_folder);
        auto recording = Recording::start(m_log, m_path, {}, {}, 0, limits);
        ASSERT_TRUE(recording) << recording.error().text;
        m_recording = std::move(*recording);
        append(m_log, 0, 100);
        ASSERT_TRUE(waitFor([&] { return m_recording->figures().packets == 100; }));
    }
    /// Goes on in the file of that name, which has all that was received and will be.
    void expectAllIn(const std::string& path, const std::string& problem) {
        ASSERT_TRUE(waitFor([&] { return !m_recording->figures().displaced.empty(); }));
        const Displaced told = m_recording->figures().displaced.front();
        EXPECT_THAT(told.problem, testing::StartsWith(m_path + ": "));
        EXPECT_THAT(told.problem, testing::HasSubstr(problem));
        EXPECT_EQ(told.path, path);
        EXPECT_EQ(told.lost, 0U);
        append(m_log, 100, 103);
        EXPECT_TRUE(m_recording->stop({"at its end"}));
        EXPECT_EQ(m_recording->figures().path, path);
        EXPECT_EQ(m_recording->figures().packets, 103U);
        EXPECT_EQ(m_recording->figures().bytes, std::filesystem::file_size(path));
        EXPECT_EQ(recordedInFile(path).size(), 103U);
        EXPECT_THAT(notesIn(path), testing::Contains("at its end"));
        EXPECT_EQ(m_recording->figures().displaced.size(), 1U);
    }

    PacketLog m_log;
    const std::string m_folder = newFile();
    const std::string m_path = nameOf(pathOf(m_folder) / "take.pcapng");
    const std::string m_next = partPath(m_path, 2);
    std::unique_ptr<Recording> m_recording;
};

TEST_F(DisplacedRecording, IsWholeInANewFileIfItsOwnIsRemoved) {
    begin();
    m_recording->setMarks({{7, "", "here"}});
    std::filesystem::remove(m_path);
    expectAllIn(m_next, "removed");
    EXPECT_THAT(notesIn(m_next), testing::Contains("Mark on packet 7: here"));
}

TEST_F(DisplacedRecording, IsWholeInANewFileIfItsOwnIsMoved) {
    begin();
    const std::string moved = newFile();
    std::filesystem::rename(m_path, moved);
    expectAllIn(m_next, "moved");
    EXPECT_EQ(recordedInFile(moved).size(), 100U) << "ended as well as it can";
}

TEST_F(DisplacedRecording, MakesItsFolderAgain) {
    begin();
    std::filesystem::remove_all(m_folder);
    expectAllIn(m_next, "removed");
}

TEST_F(DisplacedRecording, GoesOnInTheOtherFolderIfItsOwnCannotBeMade) {
    const std::string other = newFile();
    begin({.otherFolder = other});
    std::filesystem::remove_all(m_folder);
    std::ofstream(pathOf(m_folder)) << "a file";
    const std::string path = nameOf(pathOf(other) / "take part 3.pcapng");
    expectAllIn(path, "removed");
}

TEST_F(DisplacedRecording, IsWholeInANewFileIfItsOwnIsReplaced) {
    begin();
    const std::string foreign = newFile();
    std::ofstream(pathOf(foreign)) << "of somebody else";
    std::filesystem::rename(foreign, m_path);
    expectAllIn(m_next, "another file");
    EXPECT_EQ(std::filesystem::file_size(m_path), 16U);
}

#ifndef _WIN32 // where a hole takes the place of what was cut
TEST_F(DisplacedRecording, IsWholeInANewFileIfItsOwnIsCut) {
    begin();
    std::filesystem::resize_file(m_path, 100);
    append(m_log, 100, 103); // no hole hides that
    ASSERT_TRUE(waitFor([&] { return !m_recording->figures().displaced.empty(); }));
    EXPECT_TRUE(m_recording->stop());
    EXPECT_EQ(recordedInFile(m_next).size(), 103U);
}
#endif

TEST_F(DisplacedRecording, IsWholeIfItsFileGoesAtTheLastMoment) {
    begin();
    std::filesystem::remove(m_path);
    EXPECT_TRUE(m_recording->stop());
    EXPECT_EQ(m_recording->figures().path, m_next);
    EXPECT_EQ(recordedInFile(m_next).size(), 100U);
}

TEST_F(DisplacedRecording, HasTheEarlierFilesThatAreGoneToo) {
    begin({.fileBytes = 10'000});
    ASSERT_TRUE(waitFor([&] { return m_recording->figures().files == 2; }));
    append(m_log, 100, 103);
    ASSERT_TRUE(waitFor([&] { return m_recording->figures().packets == 103; }));
    std::filesystem::remove_all(m_folder);
    ASSERT_TRUE(waitFor([&] { return !m_recording->figures().displaced.empty(); }));
    EXPECT_TRUE(m_recording->stop());
    const std::string path = m_recording->figures().path;
    EXPECT_EQ(path, partPath(m_path, 3));
    EXPECT_EQ(recordedInFile(path).size(), 103U);
    EXPECT_EQ(m_recording->figures().displaced.front().lost, 0U);
}

TEST_F(DisplacedRecording, KeepsTheEarlierFilesThatAreThere) {
    begin({.fileBytes = 10'000});
    ASSERT_TRUE(waitFor([&] { return m_recording->figures().files == 2; }));
    append(m_log, 100, 103);
    ASSERT_TRUE(waitFor([&] { return m_recording->figures().packets == 103; }));
    std::filesystem::remove(m_next);
    ASSERT_TRUE(waitFor([&] { return !m_recording->figures().displaced.empty(); }));
    EXPECT_TRUE(m_recording->stop());
    EXPECT_EQ(m_recording->figures().path, m_path);
    EXPECT_EQ(m_recording->figures().packets, 103U);
    EXPECT_EQ(m_recording->figures().files, 2U);
    EXPECT_EQ(recordedInFile(partPath(m_path, 3)).size(), 3U);
}

TEST_F(DisplacedRecording, EndsIfEveryFileIsTakenAway) {
    begin();
    std::size_t removed = 0;
    ASSERT_TRUE(waitFor([&] {
        removed += std::filesystem::remove_all(m_folder);
        return m_recording->failure().has_value();
    })) << removed;
    EXPECT_EQ(m_recording->failure()->kind, FileError::Kind::Displaced);
}

TEST_F(DisplacedRecording, SaysWhatTheLogHadDropped) {
    PacketLog log(kSmallLog);
    std::filesystem::create_directory(m_folder);
    const auto recording = Recording::start(log, m_path, {});
    ASSERT_TRUE(recording) << recording.error().text;
    for (std::uint32_t sample = 0; sample < 5000; sample += 500) {
        append(log, sample, sample + 500);
        ASSERT_TRUE(waitFor([&] { return (*recording)->figures().packets == sample + 500; }));
    }
    std::filesystem::remove(m_path);
    ASSERT_TRUE(waitFor([&] { return !(*recording)->figures().displaced.empty(); }));
    ASSERT_TRUE((*recording)->stop());
    const std::uint64_t lost = (*recording)->figures().displaced.front().lost;
    EXPECT_GT(lost, 0U);
    EXPECT_EQ((*recording)->figures().packets + lost, 5000U);
}

/// Whose disk stands still while its gate is closed.
class GatedSink final : public ByteSink {
public:
    struct Gate {
        std::mutex mutex;
        std::condition_variable changed;
        bool isOpen = true;
        bool isWaitedAt = false;
        ByteVector bytes;

        void open(bool opened) {
            const std::lock_guard lock(mutex);
            isOpen = opened;
            changed.notify_all();
        }
    };
    explicit GatedSink(Gate& gate) : m_gate(gate) {}

    tl::expected<void, FileError> write(std::span<const std::byte> more) override {
        std::unique_lock lock(m_gate.mutex);
        m_gate.isWaitedAt = !m_gate.isOpen;
        m_gate.changed.notify_all();
        m_gate.changed.wait(lock, [this] { return m_gate.isOpen; });
        m_gate.bytes.insert(m_gate.bytes.end(), more.begin(), more.end());
        return {};
    }
    tl::expected<void, FileError> flush() override { return {}; }

private:
    Gate& m_gate;
};

TEST(Recording, CountsPacketsOfMarksAsTheFileHasThem) {
    PacketLog log(kSmallLog);
    GatedSink::Gate gate;
    const auto recording = Recording::start(log, std::make_unique<GatedSink>(gate), {});
    ASSERT_TRUE(recording) << recording.error().text;
    gate.open(false);
    append(log, 0, 1);
    {
        std::unique_lock lock(gate.mutex);
        gate.changed.wait(lock, [&] { return gate.isWaitedAt; });
    }
    append(log, 1, 5000); // more than the log holds
    (*recording)->setMarks({{0, "", ""}, {1, "", "missed"}, {4998, "", ""}});
    gate.open(true);
    ASSERT_TRUE((*recording)->stop());
    const std::uint64_t missed = (*recording)->figures().missed;
    ASSERT_GT(missed, 0U);
    const std::string text(reinterpret_cast<const char*>(gate.bytes.data()), gate.bytes.size());
    std::istringstream stream(text);
    EXPECT_THAT(notesIn(*test::readingFrom(stream, "memory")),
                testing::ElementsAre("Mark on packet 0", "Mark on packet 1: missed",
                                     "Mark on packet " + std::to_string(4998 - missed)));
    const auto seen = recordedIn(gate.bytes);
    ASSERT_EQ(seen.size(), 5000 - missed);
    EXPECT_EQ(seen[4998 - missed].stamp, Stamp(Duration(4998)));
}

TEST(Recording, HasMarksInTheFileOfTheirPacketBeforeItEnds) {
    PacketLog log;
    const std::string path = newFile();
    const auto recording = Recording::start(log, path, {}, {}, 0, {.fileBytes = 10'000});
    ASSERT_TRUE(recording) << recording.error().text;
    append(log, 0, 5);
    (*recording)->setMarks({{1, "", "taken back"}, {2, "", ""}});
    ASSERT_TRUE(waitFor([&] { return notesIn(path).size() == 2; })) << "as the process might be killed";
    EXPECT_EQ((*recording)->figures().files, 1U);
    (*recording)->setMarks({{2, "", ""}, {3, "", "jumps"}});
    append(log, 5, 100);
    ASSERT_TRUE(waitFor([&] { return (*recording)->figures().files == 2; }));
    const std::uint64_t second = (*recording)->figures().fileBegin;
    ASSERT_EQ(second, 100U);
    append(log, 100, 101);
    (*recording)->setMarks({{2, "", ""}, {3, "", "jumps"}, {4, "", "late"}, {second, "", "here"}});
    ASSERT_TRUE((*recording)->stop({"3 samples lost"}));
    EXPECT_THAT(notesIn(path), testing::ElementsAre("Mark on packet 2", "Mark on packet 3: jumps"));
    EXPECT_THAT(notesIn(partPath(path, 2)), testing::ElementsAre("In an earlier file: Mark on packet 4: late",
                                                                 "Mark on packet 0: here", "3 samples lost"));
    EXPECT_EQ(recordedInFile(path).size() + recordedInFile(partPath(path, 2)).size(), second + 1);
}

TEST(Recording, BeginsNothingOnADiskThatIsTooFull) {
    PacketLog log;
    const std::string path = newFile();
    const auto recording = Recording::start(log, path, {}, {}, 0, {.leaveFree = UINT64_MAX});
    ASSERT_FALSE(recording);
    EXPECT_THAT(recording.error().text, testing::HasSubstr("MB are free on its disk"));
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(Recording, EndsWithNotesOnAllOfIt) {
    PacketLog log;
    const std::string path = newFile();
    auto recording = Recording::start(log, path, {});
    ASSERT_TRUE(recording);
    ASSERT_TRUE((*recording)->stop({"3 samples lost on Mira, network", "Mark on packet 7: here"}));
    std::ifstream file(path, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_THAT(text, testing::HasSubstr("3 samples lost on Mira, network"));
    EXPECT_THAT(text, testing::HasSubstr("Mark on packet 7: here"));
    EXPECT_TRUE(recordedInFile(path).empty()) << "and it can be read";
}

TEST(Recording, PartsHaveNamesOfTheirOwn) {
    EXPECT_EQ(partPath("/a/take 3.pcapng", 1), "/a/take 3.pcapng");
    EXPECT_EQ(pathOf(partPath("/a/take 3.pcapng", 2)), pathOf("/a/take 3 part 2.pcapng"));
    EXPECT_EQ(pathOf(partPath("/a/J\u00f6rg.pcapng", 2)), pathOf("/a/J\u00f6rg part 2.pcapng"));
    EXPECT_EQ(partPath("take", 12), "take part 12");
}

TEST(Recording, FailsWhereTheFileCannotBeMade) {
    PacketLog log;
    const auto recording = Recording::start(log, "/no/such/folder/file", {});
    ASSERT_FALSE(recording);
    EXPECT_THAT(recording.error().text, testing::StartsWith("/no/such/folder/file: cannot be written"));
}

TEST(Recording, SaysThatTheDiskIsFull) {
    if (!std::filesystem::exists("/dev/full")) {
        GTEST_SKIP() << "there is no /dev/full here";
    }
    PacketLog log;
    const auto recording = Recording::start(log, "/dev/full", {});
    ASSERT_FALSE(recording);
    EXPECT_THAT(recording.error().text, testing::HasSubstr("the disk is full"));
}

#ifndef _WIN32 // which has no such limit
/// No file of this process may grow beyond `bytes` while it lives.
class FileSizeLimit {
public:
    explicit FileSizeLimit(std::size_t bytes) : m_handler(std::signal(SIGXFSZ, SIG_IGN)) {
        ::getrlimit(RLIMIT_FSIZE, &m_before);
        rlimit limit = m_before;
        limit.rlim_cur = bytes;
        ::setrlimit(RLIMIT_FSIZE, &limit);
    }
    ~FileSizeLimit() {
        ::setrlimit(RLIMIT_FSIZE, &m_before);
        std::signal(SIGXFSZ, m_handler);
    }

private:
    rlimit m_before{};
    void (*m_handler)(int);
};

TEST(Recording, LeavesNoFileThatItCouldNotBegin) {
    PacketLog log;
    const std::string path = newFile();
    const std::string old = newFile();
    std::ofstream(pathOf(old)) << "old";
    const FileSizeLimit limit(10);
    EXPECT_FALSE(Recording::start(log, path, {}));
    EXPECT_FALSE(std::filesystem::exists(path));
    EXPECT_FALSE(Recording::start(log, old, {}, {.mayReplace = true}));
    EXPECT_TRUE(std::filesystem::exists(old));
}

TEST(Recording, KeepsWhatWasWrittenBeforeAFailureAndReportsItAgainAndAgain) {
    constexpr std::size_t most = 100'000;
    PacketLog log;
    const SenderId sender = log.senders().intern({"10.0.0.2:40001", Transport::Udp, 9763});
    const std::string path = newFile();
    const FileSizeLimit limit(most);
    auto recording = Recording::start(log, path, {});
    ASSERT_TRUE(recording) << recording.error().text;
    EXPECT_FALSE((*recording)->failure());
    for (std::uint32_t sample = 0; sample < 1000; ++sample) {
        log.writer().append(poseDatagram(sample), {Stamp(Duration(sample)), sender, 0, {}});
    }
    log.writer().publish();
    for (int i = 0; i < 2; ++i) {
        const auto stopped = (*recording)->stop();
        ASSERT_FALSE(stopped);
        EXPECT_THAT(stopped.error().text, testing::StartsWith(path + ": writing failed ("));
        EXPECT_THAT(stopped.error().text, testing::HasSubstr("what was written before can be read"));
    }
    ASSERT_TRUE((*recording)->failure());
    EXPECT_LE(std::filesystem::file_size(path), most);
    const auto seen = recordedInFile(path);
    EXPECT_GT(seen.size(), most / 1000 / 2);
    for (std::uint32_t sample = 0; sample < seen.size(); ++sample) {
        ASSERT_EQ(seen[sample].bytes, poseDatagram(sample));
    }
}
#endif

} // namespace
} // namespace posewire::log
