// SPDX-License-Identifier: MIT
#include "core/log/byte_io.h"
#include "core/log/file_names.h"
#include "core/log/output_file.h"

#include "tests/core/log/log_fixture.h"
#include "tests/support/stream_source.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <sstream>

#ifndef _WIN32
#include <sys/stat.h>
#include <unistd.h>
#endif

namespace posewire::log {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

/// A folder of its own, gone with the test.
class ByteFiles : public testing::Test {
protected:
    ~ByteFiles() override { std::filesystem::remove_all(m_folder); }
    [[nodiscard]] std::string path(const std::string& name) const { return nameOf(m_folder) + '/' + name; }
    void write(const std::string& name, std::span<const std::byte> bytes) const {
        auto file = createFile(path(name), {.mayReplace = true});
        ASSERT_TRUE(file) << file.error().text;
        ASSERT_TRUE((*file)->write(bytes));
        ASSERT_TRUE((*file)->flush());
    }
    /// All bytes, asked for in pieces of `step`.
    [[nodiscard]] std::vector<std::byte> read(const std::string& name, std::size_t step) const {
        auto file = openFile(path(name));
        EXPECT_TRUE(file) << file.error().text;
        std::vector<std::byte> all;
        std::vector<std::byte> piece(step);
        while (file) {
            const auto count = (*file)->read(piece);
            EXPECT_TRUE(count);
            if (!count || *count == 0) {
                break;
            }
            all.insert(all.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(*count));
        }
        return all;
    }

private:
    std::filesystem::path m_folder = test::newTemporaryFolder("byte_files");
};

TEST_F(ByteFiles, GiveBackWhatWasWritten) {
    for (const std::size_t size : {0U, 1U, 4095U, 4096U, 100'000U}) {
        const auto bytes = pattern(size, size);
        write("file", bytes);
        for (const std::size_t step : {1U, 7U, 4096U, 1'000'000U}) {
            EXPECT_EQ(read("file", step), bytes) << size << " by " << step;
        }
    }
}

TEST_F(ByteFiles, AreWrittenFromTheStart) {
    write("file", pattern(1000, 1));
    write("file", pattern(10, 2));
    EXPECT_EQ(read("file", 100), pattern(10, 2));
}

TEST_F(ByteFiles, AreInTheHandsOfTheSystemOnceFlushed) {
    auto file = createFile(path("file"));
    ASSERT_TRUE(file);
    for (std::size_t i = 1; i <= 5; ++i) {
        ASSERT_TRUE((*file)->write(pattern(100, 1)));
        ASSERT_TRUE((*file)->flush());
        EXPECT_EQ(std::filesystem::file_size(path("file")), 100 * i) << "the sink is still open";
    }
}

TEST_F(ByteFiles, GoByTheNameTheyWereOpenedWith) {
    write("walk.bin", pattern(10, 1));
    EXPECT_EQ((*openFile(path("walk.bin")))->name(), path("walk.bin"));
    std::istringstream stream;
    EXPECT_EQ(test::readingFrom(stream, "standard input")->name(), "standard input");
}

TEST_F(ByteFiles, CanHaveAnyName) {
    std::vector<std::string> names{"with space", "\u00e9\U0001f600", "-", "a.b.c"};
#ifndef _WIN32
    names.emplace_back("new\nline");
#endif
    for (const std::string& name : names) {
        write(name, pattern(10, 1));
        EXPECT_EQ(read(name, 100), pattern(10, 1)) << name;
    }
}

TEST_F(ByteFiles, SayWhatIsWrongWithTheName) {
    std::filesystem::create_directories(path("folder"));
    EXPECT_EQ(openFile(path("folder")).error().text, path("folder") + ": is a folder; name a file in it");
    EXPECT_EQ(openFile(path("missing")).error().text,
              path("missing") + ": no such file; check the name and the folder");
    write("file", {});
    EXPECT_THAT(openFile(path("file/inside")).error().text, HasSubstr("no such file"));
    EXPECT_THAT(openFile("").error().text, HasSubstr("no such file"));
    const std::string tooLong = path(std::string(300, 'x'));
    EXPECT_FALSE(openFile(tooLong));
#ifndef _WIN32
    EXPECT_EQ(openFile(tooLong).error().text, tooLong + ": File name too long");
#endif
}

TEST_F(ByteFiles, SayWhyTheyCannotBeWritten) {
    std::filesystem::create_directories(path("folder"));
    for (const std::string name : {"folder", "missing/file"}) {
        const auto file = createFile(path(name));
        ASSERT_FALSE(file) << name;
        EXPECT_THAT(file.error().text, StartsWith(path(name) + ": cannot be written ("));
        EXPECT_THAT(file.error().text, HasSubstr("choose another file or folder"));
    }
}

#ifndef _WIN32 // where folders say who may read, and pipes have names of their own
TEST_F(ByteFiles, SayThatTheyMayNotBeRead) {
    if (::geteuid() == 0) {
        GTEST_SKIP() << "root may read any file";
    }
    write("secret", pattern(10, 1));
    std::filesystem::permissions(path("secret"), std::filesystem::perms::none);
    EXPECT_EQ(openFile(path("secret")).error().text,
              path("secret") + ": no permission to read it; ask its owner");
}

/// Says no twice, then yes.
IsCancelled afterSome() {
    return [asked = 0]() mutable { return ++asked > 2; };
}

TEST_F(ByteFiles, AreNoLongerReadOnceThatIsCancelled) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    std::vector<std::byte> into(100'000);
    for (const std::string& name : {path("pipe"), std::string("/dev/zero")}) {
        auto file = openFile(name, afterSome());
        ASSERT_TRUE(file) << file.error().text;
        tl::expected<std::size_t, FileError> count;
        do {
            count = (*file)->read(into);
        } while (count && *count != 0);
        ASSERT_FALSE(count) << name << ": nobody writes it, or it has no end";
        EXPECT_EQ(count.error().kind, FileError::Kind::Cancelled);
    }
}

TEST_F(ByteFiles, CanBePipesThatAreWrittenLater) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    auto file = openFile(path("pipe"));
    ASSERT_TRUE(file);
    std::vector<std::byte> into(100);
    {
        auto sink = createFile(path("pipe"));
        ASSERT_TRUE(sink) << sink.error().text;
        ASSERT_TRUE((*sink)->write(pattern(10, 1)));
        ASSERT_TRUE((*sink)->finish()) << "a pipe has no disk to be synchronised with";
    }
    EXPECT_EQ(*(*file)->read(into), 10U);
    EXPECT_EQ(*(*file)->read(into), 0U);
}

#endif

/// A stream whose device goes away amidst.
class FailingBuffer final : public std::stringbuf {
public:
    explicit FailingBuffer(std::size_t whole) : m_whole(whole) {}

private:
    std::streamsize xsgetn(char* into, std::streamsize count) override {
        const auto given = std::min<std::streamsize>(count, static_cast<std::streamsize>(m_whole));
        if (given == 0) {
            throw std::ios_base::failure("gone");
        }
        std::fill_n(into, given, 'x');
        m_whole -= static_cast<std::size_t>(given);
        return given;
    }
    std::size_t m_whole;
};

TEST(ByteStream, SaysThatReadingFailed) {
    FailingBuffer buffer(10);
    std::istream stream(&buffer);
    const auto source = test::readingFrom(stream, "standard input");
    std::vector<std::byte> into(10);
    EXPECT_EQ(*source->read(into), 10U);
    const auto failed = source->read(into);
    ASSERT_FALSE(failed);
    EXPECT_THAT(failed.error().text, StartsWith("standard input: reading failed"));
}

TEST(ByteStream, GivesWhatThereIsAndThenTheEnd) {
    std::istringstream stream("abcdefg");
    const auto source = test::readingFrom(stream, "x");
    std::vector<std::byte> into(5);
    EXPECT_EQ(*source->read(into), 5U);
    EXPECT_EQ(*source->read(into), 2U);
    EXPECT_EQ(into[0], std::byte{'f'});
    EXPECT_EQ(*source->read(into), 0U);
    EXPECT_EQ(*source->read(into), 0U);
}

} // namespace
} // namespace posewire::log
