// SPDX-License-Identifier: MIT
#include "core/export/comparison/pose_comparison.h"

#include "core/wire/codec.h"
#include "tests/core/export/comparison/recordings.h"
#include "tests/support/temporary_folder.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

namespace posewire::exporting {
namespace {

/// Moves one segment by 10 mm and turns it by 5°.
Recording::Change moving(std::size_t segment) {
    return [segment](wire::Datagram& datagram) {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            wire::SegmentQuaternion& item = pose->segments[segment];
            model::SegmentPose moved = model::poseFromQuaternion(item);
            moved.position.z() += 0.010;
            moved.orientation =
                moved.orientation * Eigen::AngleAxisd(5 * std::numbers::pi / 180, Eigen::Vector3d::UnitX());
            item.position = model::toFloats(moved.position);
            item.orientation = model::toFloats(moved.orientation);
        }
        return true;
    };
}

const SegmentFigures& of(const MotionComparison& comparison, int slot) {
    return *std::ranges::find(comparison.segments, slot, &SegmentFigures::slot);
}

TEST(PoseComparisonTest, TheSameRecordingDoesNotDiffer) {
    Recording recording;
    auto whole = Recording::settings();
    whole.fingers = true;
    whole.props = 1;
    recording.perform(whole, 0, 300);
    const MotionComparison result = compare(recording, recording, {AlignBy::TimeCode, 0});
    EXPECT_EQ(result.pairs, 300U);
    EXPECT_EQ(result.alone + result.outside + result.apart, 0U);
    EXPECT_EQ(result.segments.size(), 64U);
    EXPECT_EQ(result.all.millimetres.most, 0);
    EXPECT_EQ(result.all.degrees.p95, 0);
}

TEST(PoseComparisonTest, OneSegmentThatWasMovedIsFoundToTheTenth) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 300);
    second.perform(Recording::settings(), 0, 300, moving(model::segment::kRightForeArm));
    const MotionComparison result = compare(first, second, {AlignBy::TimeCode, 0});
    ASSERT_NE(result.worst(), nullptr);
    EXPECT_EQ(result.worst()->slot, model::segment::kRightForeArm);
    for (const double figure : {result.worst()->millimetres.mean, result.worst()->millimetres.median,
                                result.worst()->millimetres.p95, result.worst()->millimetres.most}) {
        EXPECT_NEAR(figure, 10, 0.05);
    }
    EXPECT_NEAR(result.worst()->degrees.median, 5, 0.02);
    EXPECT_NEAR(result.worst()->degrees.most, 5, 0.02);
    EXPECT_LT(of(result, model::segment::kHead).millimetres.most, 0.01);
    EXPECT_NEAR(result.all.millimetres.mean, 10.0 / 23, 0.01);
}

TEST(PoseComparisonTest, AShiftByNSamplesIsFoundByTimeCodeAndSeenByCounters) {
    Recording first;
    Recording second;
    auto renumbered = Recording::settings();
    renumbered.firstSample = 1 + 25;
    first.perform(Recording::settings(), 0, 300);
    second.perform(renumbered, 0, 300);
    EXPECT_EQ(compare(first, second, {AlignBy::TimeCode, 0}).all.millimetres.most, 0);
    const MotionComparison apart = compare(first, second, {AlignBy::Sample, 0});
    EXPECT_EQ(apart.pairs, 275U);
    EXPECT_EQ(apart.outside, 25U);
    EXPECT_GT(apart.all.millimetres.median, 50); // the performer walks
    EXPECT_EQ(compare(first, second, {AlignBy::Sample, 25}).all.millimetres.most, 0);
}

TEST(PoseComparisonTest, WhereItStandsCountsAsLongAsItIsWanted) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 60);
    second.perform(Recording::settings(), 0, 60, [](wire::Datagram& datagram) {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            for (wire::SegmentQuaternion& item : pose->segments) {
                item.position[1] += 0.25F;
            }
        }
        return true;
    });
    const auto mean = [&](model::DifferenceFrame frame) {
        return compare(first, second, {AlignBy::TimeCode, 0}, frame).all.millimetres.mean;
    };
    EXPECT_NEAR(mean(model::DifferenceFrame::World), 250, 0.1);
    EXPECT_NEAR(mean(model::DifferenceFrame::Heading), 0, 0.1);
    EXPECT_NEAR(mean(model::DifferenceFrame::Pelvis), 0, 0.1);
}

TEST(PoseComparisonTest, CountsWhatHasNoPartner) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 100);
    second.perform(Recording::settings(), 10, 80, [](const wire::Datagram& datagram) {
        return datagram.header.sampleCounter < 41 || datagram.header.sampleCounter > 45;
    });
    const MotionComparison result = compare(first, second, {AlignBy::TimeCode, 0});
    EXPECT_EQ(result.pairs, 65U);
    EXPECT_EQ(result.alone, 5U);
    EXPECT_EQ(result.outside, 30U);
    // In the course, too, nothing is there where nothing was compared.
    const auto& course = result.course.millimetres[DifferenceCourse::kMean];
    ASSERT_EQ(course.size(), 50U); // of two samples each
    EXPECT_TRUE(std::isnan(course[0]));
    EXPECT_FALSE(std::isnan(course[10]));
    EXPECT_TRUE(std::isnan(course[21]));
    EXPECT_TRUE(std::isnan(course[49]));
}

TEST(PoseComparisonTest, SaysWhenItWasWorst) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 120);
    const auto move = moving(model::segment::kHead);
    second.perform(Recording::settings(), 0, 120, [&move](wire::Datagram& datagram) {
        return datagram.header.sampleCounter != 61 || move(datagram);
    });
    const MotionComparison result = compare(first, second, {AlignBy::TimeCode, 0});
    const SegmentFigures& head = of(result, model::segment::kHead);
    EXPECT_NEAR(head.millimetres.most, 10, 0.05);
    EXPECT_NEAR(head.millimetres.p95, 0, 0.01);
    EXPECT_NEAR(log::secondsOf(head.millimetres.mostAt - Recording::kStart), 1, 1e-3);
    EXPECT_EQ(head.degrees.mostAt, head.millimetres.mostAt);
    EXPECT_NEAR(result.course.millimetres[model::segment::kHead][30], 10, 0.05);
}

TEST(PoseComparisonTest, ARangeIsComparedAlone) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 120);
    second.perform(Recording::settings(), 0, 120);
    const model::TimeRange range{Recording::kStart + 500ms, Recording::kStart + 1s};
    const MotionComparison result =
        compare(first, second, {AlignBy::Begin, 0}, model::DifferenceFrame::World, range);
    EXPECT_EQ(result.pairs, 30U);
    EXPECT_EQ(result.all.millimetres.most, 0); // by their beginnings, which are not in the range
    EXPECT_EQ(result.first, Recording::kStart + 500ms);
}

TEST(PoseComparisonTest, GoesBackWhereTheFirstRecordingWasPlayedTwice) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 700);
    first.perform(Recording::settings(), 0, 700);
    second.perform(Recording::settings(), 0, 700);
    const MotionComparison result = compare(first, second, {AlignBy::TimeCode, 0});
    EXPECT_EQ(result.pairs, 1400U);
    EXPECT_EQ(result.all.millimetres.most, 0);
}

TEST(PoseComparisonTest, BodiesWithoutACommonSegmentAreCounted) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 10, [](wire::Datagram& datagram) {
        if (auto* pose = std::get_if<wire::PoseQuaternion>(&datagram.body)) {
            for (wire::SegmentQuaternion& item : pose->segments) {
                item.position[0] = std::nanf("");
            }
        }
        return true;
    });
    second.perform(Recording::settings(), 0, 10);
    const MotionComparison result = compare(first, second, {AlignBy::TimeCode, 0});
    EXPECT_EQ(result.pairs, 0U);
    EXPECT_EQ(result.worst(), nullptr);
    EXPECT_EQ(result.apart + result.alone + result.outside, first.timetable()->samples().size());
}

TEST(PoseComparisonTest, StopsWhenItIsNotWantedAnyMore) {
    Recording recording;
    recording.perform(Recording::settings(), 0, 100);
    const feed::PoseSource source = recording.source();
    const Partners partners(recording.timetable(), recording.timetable(), {});
    const auto result = compareMotion({source, source, partners}, [](double) { return false; });
    ASSERT_FALSE(result.has_value());
    EXPECT_EQ(result.error().kind, log::FileError::Kind::Cancelled);
    EXPECT_FALSE(Timetable::of(source, [](double) { return false; }).has_value());
}

TEST(PoseComparisonTest, CountsWhatTheLogDroppedBeforeItWasLookedAt) {
    log::PacketLog small{{.memoryCap = std::size_t{1} << 20, .chunkSize = std::size_t{256} << 10}};
    Recording recording;
    recording.perform(Recording::settings(), 0, 600);
    log::LogReader whole(recording.packets);
    const std::uint64_t all = whole.end();
    const auto begin = [&small] { return log::LogReader(small).begin(); };
    const auto copy = [&] {
        for (std::uint64_t number = 0; number < all; ++number) {
            const auto packet = whole.packet(number);
            log::Arrival arrival;
            arrival.stamp = packet->stamp;
            arrival.sender = small.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
            small.writer().append(packet->bytes, arrival);
        }
        small.writer().publish();
    };
    copy();
    feed::PoseSource source = recording.source();
    source.log = &small; // as a session of that log would name it
    source.characters[0].parts[0].key.sender =
        small.senders().intern({"127.0.0.1:40001", log::Transport::Udp, 9763});
    const auto table = recording.timetable();
    const Partners partners(table, table, {AlignBy::TimeCode, 0});
    const feed::PoseSource second = recording.source();
    const ComparisonTask task{source, second, partners};
    const MotionComparison before = *compareMotion(task, {});
    EXPECT_EQ(before.passedOver, begin());
    for (int i = 0; i < 4; ++i) {
        copy(); // the log goes on while the comparison is held up
    }
    const MotionComparison after = *compareMotion(task, {});
    EXPECT_GT(after.passedOver, before.passedOver);
    EXPECT_EQ(after.passedOver, std::min(all, begin()));
    const std::string path = (posewire::test::newTemporaryFolder("comparison") / "late.csv").string();
    const auto written = writeComparisonCsv(task, before.segments, path, {}, {});
    ASSERT_FALSE(written);
    EXPECT_THAT(written.error().text, testing::HasSubstr("the log dropped part of the range"));
    EXPECT_FALSE(std::filesystem::exists(path));
}

TEST(PoseComparisonTest, CsvHasARowForEachSampleAndEmptyCellsWithoutAPartner) {
    Recording first;
    Recording second;
    first.perform(Recording::settings(), 0, 3);
    second.perform(Recording::settings(), 1, 3, moving(model::segment::kPelvis));
    const Partners partners(first.timetable(), second.timetable(), {AlignBy::TimeCode, 0});
    const feed::PoseSource one = first.source();
    const feed::PoseSource other = second.source();
    const ComparisonTask task{one, other, partners};
    const MotionComparison result = *compareMotion(task, {});
    const std::filesystem::path folder = posewire::test::newTemporaryFolder("comparison");
    const std::string path = (folder / "difference.csv").string();
    ASSERT_TRUE(writeComparisonCsv(task, result.segments, path, {}, {}));
    std::ifstream file(path);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        lines.push_back(line);
    }
    file.close();
    ASSERT_EQ(lines.size(), 4U);
    EXPECT_TRUE(
        lines[0].starts_with("time,sample,timeCode,otherSample,otherTimeCode,Pelvis mm,Pelvis degrees,"));
    EXPECT_TRUE(lines[1].starts_with("0.0000,1,36000000,,,,")) << lines[1];
    const std::string code = std::to_string(partners.first().samples()[1].timeCode);
    EXPECT_TRUE(lines[2].starts_with("0.0167,2," + code + ",2," + code + ",10.00,5.00")) << lines[2];
    EXPECT_FALSE(writeComparisonCsv(task, result.segments, path, {}, {})); // it is there already
    std::filesystem::remove_all(folder);
}

TEST(SpreadTest, QuantilesAreWithinAThirdOfAPercent) {
    Spread spread;
    for (int i = 0; i <= 10'000; ++i) {
        spread.add(0.05 * i);
    }
    EXPECT_EQ(spread.count(), 10'001U);
    EXPECT_NEAR(spread.mean(), 250, 1e-6);
    EXPECT_NEAR(spread.quantile(0.5), 250, 250 * 0.003);
    EXPECT_NEAR(spread.quantile(0.95), 475, 475 * 0.003);
    EXPECT_NEAR(spread.quantile(1), 500, 500 * 0.003);
    EXPECT_EQ(spread.most(), 500);
    EXPECT_EQ(Spread().quantile(0.5), 0);
    spread.add(std::nan(""));
    EXPECT_EQ(spread.count(), 10'001U);
}

} // namespace
} // namespace posewire::exporting
