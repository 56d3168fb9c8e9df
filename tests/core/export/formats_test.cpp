// SPDX-License-Identifier: MIT
#include "core/export/formats.h"
#include "core/model/session/session.h"

#include "core/export/sheets.h"
#include "core/log/packet_log.h"

#include <gtest/gtest.h>

#include <set>

namespace posewire::exporting {
namespace {

template <class Subject>
void expectUsable() {
    std::set<std::string> suffixes;
    ASSERT_FALSE(formats<Subject>().empty());
    for (const Format<Subject>& format : formats<Subject>()) {
        EXPECT_TRUE(suffixes.insert(format.suffix).second) << format.suffix << " is there twice";
        EXPECT_NE(std::string(format.title), "");
        EXPECT_NE(std::string(format.kind), "");
        EXPECT_EQ(&formatFor<Subject>("a." + std::string(format.suffix)), &format);
    }
}

TEST(Formats, AreToldApartByTheirSuffix) {
    expectUsable<EventSheet>();
    expectUsable<NullPoseSheet>();
    expectUsable<ReportSheet>();
}

TEST(Formats, ASuffixCountsInWhateverCaseAndOnlyBehindADot) {
    EXPECT_TRUE(hasSuffix("a.b.JSON", "json"));
    EXPECT_FALSE(hasSuffix("json", "json"));
    EXPECT_FALSE(hasSuffix("a.json.txt", "json"));
}

TEST(Formats, WithoutAKnownSuffixItIsTheUsualOne) {
    EXPECT_STREQ(formatFor<EventSheet>("events").suffix, "csv");
    EXPECT_STREQ(formatFor<NullPoseSheet>("pose.txt").suffix, "csv");
}

TEST(Formats, WriteWhatTheirWritersWrite) {
    log::PacketLog log;
    model::Session session(log);
    EXPECT_EQ(formatFor<EventSheet>("a.csv").write({session, {}}), eventsCsv({session, {}}));
    EXPECT_EQ(formatFor<EventSheet>("a.json").write({session, {}}), eventsJson({session, {}}));
    EXPECT_EQ(formatFor<NullPoseSheet>("a.json").write({}), nullPoseJson({}));
}

} // namespace
} // namespace posewire::exporting
