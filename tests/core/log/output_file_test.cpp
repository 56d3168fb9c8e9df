// SPDX-License-Identifier: MIT
#include "core/log/output_file.h"

#include "tests/core/log/log_fixture.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <thread>

#ifndef _WIN32
#include <sys/stat.h>
#endif

namespace posewire::log {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

/// A folder of its own with a file, gone with the test.
class OutputFile : public testing::Test {
protected:
    OutputFile() { std::ofstream(path("old")) << "old"; }
    ~OutputFile() override { fs::remove_all(m_folder); }

    [[nodiscard]] std::string path(const std::string& name) const { return (m_folder / name).string(); }
    [[nodiscard]] std::string content(const std::string& name) const {
        std::ifstream file(path(name), std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    [[nodiscard]] std::ptrdiff_t filesThere() const {
        return std::distance(fs::directory_iterator(m_folder), fs::directory_iterator());
    }
    [[nodiscard]] static std::span<const std::byte> bytes(std::string_view text) {
        return std::as_bytes(std::span(text));
    }

private:
    fs::path m_folder = test::newTemporaryFolder("output_file");
};

TEST_F(OutputFile, IsNotReplacedWithoutLeave) {
    for (const auto create : {createFile, createWholeFile}) {
        const auto refused = create(path("old"), {});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().text,
                  path("old") + ": exists already; choose another name, or add --force to replace it");
    }
    EXPECT_FALSE(checkOutput(path("old"), {}));
    EXPECT_EQ(content("old"), "old");
    EXPECT_TRUE(writeWholeFile(path("old"), bytes("new"), {.mayReplace = true}));
    EXPECT_EQ(content("old"), "new");
}

TEST_F(OutputFile, IsNeverOneThatIsBeingRecordedTo) {
    auto sink = createFile(path("new"));
    ASSERT_TRUE(sink && (*sink)->write(bytes("recorded")) && (*sink)->flush());
    for (const auto create : {createFile, createWholeFile}) {
        const auto refused = create(path("new"), {.mayReplace = true});
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().text,
                  path("new") + ": is being recorded to at present; choose another name");
    }
    EXPECT_FALSE(checkOutput(path("new"), {.mayReplace = true}));
    EXPECT_TRUE((*sink)->finish());
    EXPECT_EQ(content("new"), "recorded");
    sink->reset();
    EXPECT_TRUE(createFile(path("new"), {.mayReplace = true}));
}

TEST_F(OutputFile, IsNeverOneThatIsInUse) {
    fs::create_hard_link(path("old"), path("twin"));
    std::vector<std::string> names{"old", "twin", "./old"};
#ifdef _WIN32
    names.emplace_back("OLD"); // links need a right that few have there
#else
    fs::create_symlink("old", path("link"));
    names.emplace_back("link");
#endif
    for (const std::string& name : names) {
        const OutputRules rules{.mayReplace = true, .inUse = {path("old")}};
        EXPECT_FALSE(checkOutput(path(name), rules)) << name;
        EXPECT_FALSE(createFile(path(name), rules)) << name;
        const auto refused = createWholeFile(path(name), rules);
        ASSERT_FALSE(refused) << name;
        EXPECT_THAT(refused.error().text, StartsWith(path(name) + ": is "));
        EXPECT_THAT(refused.error().text, HasSubstr("choose another file"));
        EXPECT_EQ(content("old"), "old");
    }
}

TEST_F(OutputFile, IsThereWholeOrNotAtAll) {
    for (const char* name : {"old", "new"}) {
        const auto before = filesThere();
        {
            auto sink = createWholeFile(path(name), {.mayReplace = true});
            ASSERT_TRUE(sink);
            ASSERT_TRUE((*sink)->write(bytes("half")));
            ASSERT_TRUE((*sink)->flush());
            EXPECT_EQ(content(name), name == std::string("old") ? "old" : "");
        }
        EXPECT_EQ(filesThere(), before) << "nothing is left of it";
        EXPECT_EQ(content(name), name == std::string("old") ? "old" : "");
        ASSERT_TRUE(writeWholeFile(path(name), bytes("whole"), {.mayReplace = true}));
        EXPECT_EQ(content(name), "whole");
    }
    EXPECT_EQ(filesThere(), 2);
}

TEST_F(OutputFile, DoesNotReplaceOneThatAppearsMeanwhile) {
    auto sink = createWholeFile(path("new"));
    ASSERT_TRUE(sink);
    std::ofstream(path("new")) << "of somebody else";
    const auto finished = (*sink)->finish();
    ASSERT_FALSE(finished);
    EXPECT_THAT(finished.error().text, HasSubstr("exists by now"));
    EXPECT_EQ(content("new"), "of somebody else");
}

TEST_F(OutputFile, MayBeADeviceOrAPipeWithoutLeave) {
#ifdef _WIN32
    const std::string device = "NUL";
#else
    const std::string device = "/dev/null";
#endif
    for (const auto create : {createFile, createWholeFile}) {
        auto sink = create(device, {});
        ASSERT_TRUE(sink) << sink.error().text;
        EXPECT_TRUE((*sink)->write(bytes("x")));
        EXPECT_TRUE((*sink)->finish());
    }
#ifndef _WIN32
    EXPECT_TRUE(fs::is_character_file(device));
#endif
}

TEST_F(OutputFile, IsRefusedBeforehandWhereItsFolderIsNot) {
    EXPECT_THAT(checkOutput(path("missing/file"), {}).error().text,
                HasSubstr("choose another file or folder"));
    EXPECT_TRUE(checkOutput(path("new"), {}));
    EXPECT_FALSE(fs::exists(path("new")));
}

#ifndef _WIN32 // what links, rights and descriptors are there
TEST_F(OutputFile, IsWrittenBehindALinkAndKeepsItsRights) {
    fs::create_symlink("old", path("link"));
    fs::permissions(path("old"), fs::perms::owner_read | fs::perms::owner_write);
    ASSERT_TRUE(writeWholeFile(path("link"), bytes("new"), {.mayReplace = true}));
    EXPECT_TRUE(fs::is_symlink(path("link")));
    EXPECT_EQ(content("old"), "new");
    EXPECT_EQ(fs::status(path("old")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(OutputFile, IsPrivateUnlessOthersAreToReadIt) {
    const auto modeOf = [this](const std::string& name) {
        return static_cast<unsigned>(fs::status(path(name)).permissions());
    };
    const auto make = [&](const std::string& name) {
        EXPECT_TRUE(createFile(path(name)));
        EXPECT_TRUE(writeWholeFile(path(name + " whole"), bytes("new")));
        EXPECT_TRUE(makeFolder(path(name + " in/folder")));
    };
    make("private");
    EXPECT_EQ(setFileMode("0664"), "");
    make("shared");
    EXPECT_TRUE(writeWholeFile(path("private whole"), bytes("newer"), {.mayReplace = true}));
    for (const char* const wrong : {"", "8", "0444", "0755", "1600", "-600", "0600 "}) {
        EXPECT_NE(setFileMode(wrong), "") << wrong;
    }
    EXPECT_EQ(setFileMode("600"), "");
    for (const char* const file : {"private", "private whole"}) {
        EXPECT_EQ(modeOf(file), 0600U) << file;
    }
    for (const char* const file : {"shared", "shared whole"}) {
        EXPECT_EQ(modeOf(file), 0664U) << file;
    }
    for (const char* const folder : {"private in", "private in/folder"}) {
        EXPECT_EQ(modeOf(folder), 0700U) << folder;
    }
    for (const char* const folder : {"shared in", "shared in/folder"}) {
        EXPECT_EQ(modeOf(folder), 0775U) << folder;
    }
}

TEST_F(OutputFile, IsNoPipeWithoutAReader) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    for (const auto create : {createFile, createWholeFile}) {
        const auto unread = create(path("pipe"), {});
        ASSERT_FALSE(unread);
        EXPECT_EQ(unread.error().text, path("pipe") + ": is a pipe without a reader; start its reader first");
        const auto reader = openFile(path("pipe"));
        EXPECT_TRUE(create(path("pipe"), {}));
    }
}

TEST_F(OutputFile, WaitsForRoomInAPipe) {
    ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
    const auto reader = openFile(path("pipe"));
    const auto sink = createFile(path("pipe"));
    ASSERT_TRUE(sink) << sink.error().text;
    const std::vector<std::byte> much = pattern(std::size_t{1} << 20, 1); // a pipe holds 64 KiB
    std::thread writer([&] {
        EXPECT_TRUE((*sink)->write(much));
        EXPECT_TRUE((*sink)->finish());
    });
    std::vector<std::byte> read(much.size());
    for (std::size_t size = 0; size < read.size();) {
        size += *(*reader)->read(std::span(read).subspan(size));
    }
    writer.join();
    EXPECT_EQ(read, much);
}

TEST_F(OutputFile, SaysThatALinkLeadsNowhere) {
    fs::create_symlink("nowhere", path("link"));
    EXPECT_THAT(createFile(path("link")).error().text, HasSubstr("a link to a file that does not exist"));
}

#endif

} // namespace
} // namespace posewire::log
