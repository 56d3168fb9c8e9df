// SPDX-License-Identifier: MIT
#include "core/model/body/provenance.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

TEST(SourceText, SaysOnceWhatHoldsForBoth) {
    EXPECT_EQ(sourceText({Provenance::Sent, Provenance::Sent}), "Sent");
    EXPECT_EQ(sourceText({Provenance::Assumed, Provenance::Assumed}), "Assumed");
    EXPECT_EQ(sourceText({}), "Missing");
}

TEST(SourceText, TellsPositionOrientationAndTurnApart) {
    EXPECT_EQ(sourceText({Provenance::Sent, Provenance::Solved}), "Position sent, orientation solved");
    EXPECT_EQ(sourceText({Provenance::Sent, Provenance::Solved, true}),
              "Position sent, orientation solved, turn about itself assumed");
}

} // namespace
} // namespace posewire::model
