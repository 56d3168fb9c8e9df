// SPDX-License-Identifier: MIT
#include "core/model/session/roster.h"
#include "tests/core/export/motion/motion_fixture.h"

namespace posewire::exporting {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class MotionExportTest : public MotionTest {};

/// A format that holds one character, whatever there is.
std::unique_ptr<MotionWriter> makeNames(const MotionTask& task) {
    class Names final : public MotionWriter {
    public:
        explicit Names(const MotionTask& task) : m_task(task) {}
        void begin(MotionOutput& out) override {
            for (const std::size_t place : m_task.characters) {
                out.write(m_task.characterAt(place).name.shown() + '\n');
            }
        }
        void add(const MotionFrame&, MotionOutput& out) override { out.write("."); }

    private:
        const MotionTask& m_task;
    };
    return std::make_unique<Names>(task);
}
constexpr MotionFormat kAlone{.title = "Names",
                              .kind = "Names",
                              .suffix = "txt",
                              .holds = "names",
                              .gaps = words::Kind::Nothing,
                              .make = makeNames};

TEST_F(MotionExportTest, FindsFormatsByTheirSuffix) {
    for (const MotionFormat& format : motionFormats()) {
        EXPECT_EQ(findMotionFormat(format.suffix), &format);
        EXPECT_EQ(motionFormatOf(std::string("a.b/take.") + format.suffix), &format);
    }
    EXPECT_EQ(motionFormatOf("TAKE.CSV"), findMotionFormat("csv"));
    EXPECT_EQ(motionFormatOf("csv"), nullptr);
    EXPECT_EQ(motionFormatOf("take.pcap"), nullptr);
}

TEST_F(MotionExportTest, TellsWhatIsInEachFile) {
    perform(settings(2), 50, without({10, 11}));
    const auto exported = write("csv", source());
    ASSERT_TRUE(exported);
    ASSERT_EQ(exported->size(), 2U);
    EXPECT_EQ((*exported)[1].character, 1U);
    EXPECT_EQ((*exported)[1].frames, 50U);
    EXPECT_EQ((*exported)[1].gaps, 2U);
    EXPECT_EQ((*exported)[1].restarts, 0U);
    EXPECT_THAT(filesLeft(), ElementsAre("take.csv"));
}

TEST_F(MotionExportTest, GivesCharactersAFileEachWhereOneHoldsOne) {
    perform(settings(2), 5);
    const feed::PoseSource two = source();
    const auto exported = exportMotion({two, kAlone, path("take.txt"), {}, ""});
    ASSERT_TRUE(exported);
    for (std::size_t i = 0; i < 2; ++i) {
        const std::string name = two.characters[i].name.shown();
        EXPECT_EQ((*exported)[i].path, path("take-" + name + ".txt"));
        EXPECT_EQ(textOf((*exported)[i].path), name + "\n.....");
    }
    EXPECT_EQ(filesLeft().size(), 2U);
}

TEST_F(MotionExportTest, TellsFilesOfOneNameApart) {
    perform(settings(3), 2, [](const wire::Datagram& datagram) { return datagram.header.type() != 12; });
    feed::PoseSource three = source();
    for (feed::PoseCharacter& one : three.characters) {
        one.name = "../Twin";
    }
    three.characters[1].name = "../TWIN";
    EXPECT_THAT(
        motionPaths({three, kAlone, "out/take.txt"}),
        ElementsAre(testing::HasSubstr("take-_"), testing::EndsWith("-2.txt"), testing::EndsWith("-3.txt")));
    for (const std::string& path : motionPaths({three, kAlone, "out/take.txt"})) {
        EXPECT_EQ(std::filesystem::path(path).parent_path(), "out");
    }
}

TEST_F(MotionExportTest, LeavesNothingWhereItIsCancelled) {
    perform(settings(2), 3'000);
    for (const double at : {0.0, 0.2, 0.6, 0.9}) {
        const auto exported = write("csv", source(), [&](double share) { return share < at; });
        ASSERT_FALSE(exported);
        EXPECT_EQ(exported.error().kind, log::FileError::Kind::Cancelled);
        EXPECT_THAT(filesLeft(), IsEmpty());
    }
}

TEST_F(MotionExportTest, WritesEveryFormatTheSameEachTime) {
    auto all = settings(2);
    all.types = {2, 3, 12, 13};
    all.fingers = true;
    all.props = 1;
    perform(all, 300, without({50, 51, 200}));
    const feed::PoseSource two = source();
    for (const MotionFormat& format : motionFormats()) {
        const auto first = write(format.suffix, two);
        ASSERT_TRUE(first) << first.error().text;
        std::vector<std::string> texts;
        for (const ExportedMotion& one : *first) {
            texts.push_back(textOf(one.path));
            EXPECT_GT(texts.back().size(), 10'000U) << format.suffix;
            EXPECT_EQ(one.frames - one.gaps, 297U) << format.suffix;
            EXPECT_EQ(one.content == feed::PoseContent::Markers, format.takesMarkers);
        }
        EXPECT_EQ(texts.size(), 2U);
        EXPECT_EQ(filesLeft().size(), format.holdsSeveral ? 1U : 2U);
        for (const ExportedMotion& one : *first) {
            std::filesystem::remove(one.path);
        }
        EXPECT_FALSE(write(format.suffix, two, [](double share) { return share < 0.5; }));
        EXPECT_THAT(filesLeft(), IsEmpty()) << format.suffix;
        const auto second = write(format.suffix, two);
        ASSERT_TRUE(second);
        for (std::size_t i = 0; i < texts.size(); ++i) {
            EXPECT_TRUE(textOf((*second)[i].path) == texts[i]) << format.suffix; // too long to be shown
        }
        for (const ExportedMotion& one : *second) {
            std::filesystem::remove(one.path);
        }
    }
}

TEST_F(MotionExportTest, WritesNothingWhereTheLogDropsWhatItReads) {
    log::PacketLog small({.memoryCap = std::size_t{4} << 20, .chunkSize = std::size_t{256} << 10});
    model::Session session(small);
    const auto receive = [&](std::uint64_t frames) {
        performer::Performer performer(settings());
        for (std::uint64_t frame = 0; frame < frames; ++frame) {
            for (const wire::Datagram& datagram : performer.frame(frame)) {
                log::Arrival arrival;
                arrival.stamp = kStart + frame * 16ms;
                arrival.sender = small.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
                small.writer().append(wire::encode(datagram).value(), arrival);
            }
        }
        small.writer().publish();
    };
    receive(3'000);
    while (session.follow(kStart + 48s)) {
    }
    const feed::PoseSource all =
        feed::poseSourceOf(session, model::kAllTime, std::vector{session.atNow().roster().listed()[0]->key});
    bool hasDropped = false;
    const auto exported = write("bvh", all, [&](double share) {
        if (share >= 0.5 && !std::exchange(hasDropped, true)) {
            receive(9'000);
        }
        return true;
    });
    ASSERT_FALSE(exported);
    EXPECT_THAT(exported.error().text, HasSubstr("choose a later beginning"));
    EXPECT_THAT(filesLeft(), IsEmpty());
}

TEST_F(MotionExportTest, GrowsFromNothingToAll) {
    perform(settings(1), 9'000);
    double last = 0;
    int steps = 0;
    ASSERT_TRUE(write("csv", source(), [&](double share) {
        EXPECT_GE(share, last);
        EXPECT_LE(share, 1);
        last = share;
        ++steps;
        return true;
    }));
    EXPECT_GT(last, 0.8);
    EXPECT_GT(steps, 4);
}

TEST_F(MotionExportTest, ReplacesNothingUnasked) {
    perform(settings(2), 3);
    const feed::PoseSource two = source();
    const std::string second = motionPaths({two, kAlone, path("take.txt")})[1];
    std::ofstream(second) << "precious";
    const auto exported = exportMotion({two, kAlone, path("take.txt"), {}, ""});
    ASSERT_FALSE(exported);
    EXPECT_THAT(exported.error().text, HasSubstr("exists already"));
    EXPECT_EQ(textOf(second), "precious");
    EXPECT_EQ(filesLeft().size(), 1U);
    EXPECT_TRUE(exportMotion({two, kAlone, path("take.txt"), {.mayReplace = true}, ""}));
    EXPECT_NE(textOf(second), "precious");
}

TEST_F(MotionExportTest, WritesNothingWhereThereIsNothing) {
    auto silent = settings();
    silent.types = {12, 25};
    perform(silent, 20);
    const auto exported = write("csv", source());
    ASSERT_TRUE(exported);
    EXPECT_THAT(*exported, IsEmpty());
    EXPECT_THAT(filesLeft(), IsEmpty());
}

} // namespace
} // namespace posewire::exporting
