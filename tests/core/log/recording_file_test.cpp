// SPDX-License-Identifier: MIT
#include "core/log/recording_file.h"

#include "tests/core/log/datagram_fixture.h"
#include "tests/support/paths.h"
#include "tests/support/stream_source.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

namespace posewire::log {
namespace {

using ::testing::HasSubstr;

std::string textOf(const ByteVector& bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Gives its bytes in pieces of three, then fails.
class FailingSource final : public ByteSource {
public:
    explicit FailingSource(ByteVector bytes) : m_bytes(std::move(bytes)) {}

    tl::expected<std::size_t, FileError> read(std::span<std::byte> into) override {
        if (m_at == m_bytes.size()) {
            return tl::unexpected(FileError{"gone"});
        }
        const std::size_t count = std::min({into.size(), m_bytes.size() - m_at, std::size_t{3}});
        std::copy_n(m_bytes.begin() + static_cast<std::ptrdiff_t>(m_at), count, into.begin());
        m_at += count;
        return count;
    }
    [[nodiscard]] std::string name() const override { return "failing"; }

private:
    ByteVector m_bytes;
    std::size_t m_at = 0;
};

struct SeenRecord {
    std::uint64_t offset;
    std::size_t size;
    bool isSkipped;
    friend bool operator==(const SeenRecord&, const SeenRecord&) = default;
};

std::vector<SeenRecord> records(ByteSource& source, tl::expected<void, FileError>& result) {
    std::vector<SeenRecord> seen;
    result = readFile(source, [&](const FileRecord& record) {
        seen.push_back({record.offset, record.bytes.size(), record.flags.skipped});
        EXPECT_FALSE(record.time.has_value());
        EXPECT_FALSE(record.sender.has_value());
    });
    return seen;
}

TEST(RecordingFile, GivesDatagramsWithTheirPlaces) {
    std::istringstream stream(textOf(joined({poseDatagram(1), textBytes("gap"), poseDatagram(2)})));
    tl::expected<void, FileError> result;
    const auto seen = records(*test::readingFrom(stream, "standard input"), result);
    EXPECT_TRUE(result.has_value());
    EXPECT_EQ(seen, (std::vector<SeenRecord>{{0, 760, false}, {760, 3, true}, {763, 760, false}}));
}

TEST(RecordingFile, WhatBeginsLikeNoCaptureIsReadAsItIs) {
    for (const std::string text :
         {"", "M", "abc", "MXTP02", "\xa1\xb2\xc3\xd5", "\xa1\xb2\xcd\x34 another kind"}) {
        std::istringstream stream(text);
        tl::expected<void, FileError> result;
        const auto seen = records(*test::readingFrom(stream, "x"), result);
        EXPECT_TRUE(result.has_value());
        EXPECT_EQ(seen.size(), text.empty() ? 0U : 1U) << text;
    }
}

TEST(RecordingFile, LongFileIsReadInPieces) {
    std::vector<ByteVector> parts;
    for (std::uint32_t i = 0; i < 500; ++i) {
        parts.push_back(poseDatagram(i));
    }
    std::istringstream stream(textOf(joined(parts)));
    tl::expected<void, FileError> result;
    EXPECT_EQ(records(*test::readingFrom(stream, "x"), result).size(), 500U);
}

TEST(RecordingFile, KeepsWhatCameBeforeAFailure) {
    FailingSource source(poseDatagram(1));
    tl::expected<void, FileError> result;
    const auto seen = records(source, result);
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().text, "gone");
    EXPECT_EQ(seen.size(), 1U);
}

TEST(RecordingFile, ADamagedCaptureIsNamedNotMisread) {
    std::istringstream stream("\x0a\x0d\x0d\x0a and more of the same");
    tl::expected<void, FileError> result;
    EXPECT_TRUE(records(*test::readingFrom(stream, "walk.pcapng"), result).empty());
    ASSERT_FALSE(result.has_value());
    EXPECT_THAT(result.error().text, HasSubstr("walk.pcapng: is damaged"));
    EXPECT_EQ(result.error().kind, FileError::Kind::Damaged);
}

TEST(RecordingFile, MissingFileAndFolderAreClearErrors) {
    const auto missing = openFile("no/such/file.bin");
    ASSERT_FALSE(missing.has_value());
    EXPECT_THAT(missing.error().text, HasSubstr("no/such/file.bin: no such file"));
    const auto folder = openFile(std::filesystem::temp_directory_path().string());
    ASSERT_FALSE(folder.has_value());
    EXPECT_THAT(folder.error().text, HasSubstr("folder"));
}

TEST(RecordingFile, ReadsTheCapturedDatagrams) {
    const std::filesystem::path folder = test::capturesFolder();
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "the captured datagrams are not here: " << folder;
    }
    for (const auto& [name, size] :
         {std::pair{"mxtp01.bin", 668U}, {"mxtp02.bin", 760U}, {"mxtp13.bin", 595U}}) {
        auto source = openFile((folder / name).string());
        ASSERT_TRUE(source.has_value()) << source.error().text;
        tl::expected<void, FileError> result;
        EXPECT_EQ(records(**source, result), (std::vector<SeenRecord>{{0, size, false}})) << name;
    }
}

} // namespace
} // namespace posewire::log
