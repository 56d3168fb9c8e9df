// SPDX-License-Identifier: MIT
#include "core/model/session/verdict.h"

#include "tests/core/model/session/verdict_fixture.h"

/// How much and whose the headline says it is.
namespace posewire::model {
namespace {

TEST_F(VerdictTest, SaysOfWhatIsOverOrJustBeganHowMuchOfItsOwnTimeIsLost) {
    for (std::uint32_t sample = 1; sample <= 600; ++sample, m_at += 10ms) {
        if (sample < 300 || sample % 5 != 0) {
            pose(sample);
        }
    }
    EXPECT_NE(verdict().text.find("20 % lost on "), std::string::npos)
        << "not of ten seconds: " << verdict().text;
    poses(601, 1'540);
    ASSERT_EQ(of(IncidentKind::Loss).size(), 1U);
    EXPECT_EQ(of(IncidentKind::Loss)[0].samples, 61U);
    EXPECT_NE(verdict().text.find("20 % lost on Character 0"), std::string::npos)
        << "as long as it is told: " << verdict().text;
    EXPECT_TRUE(verdict().brief.starts_with("20 % lost, ")) << verdict().brief;
}

} // namespace
} // namespace posewire::model
