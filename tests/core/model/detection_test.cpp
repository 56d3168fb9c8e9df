// SPDX-License-Identifier: MIT
#include "core/model/detection.h"

#include <gtest/gtest.h>

namespace posewire::model {
namespace {

wire::Header headerOf(std::uint8_t type) {
    wire::Header header;
    header.setType(type);
    return header;
}

TEST(Detector, KnowsNothingFromATypeThatAllRevisionsHave) {
    Detector detector;
    detector.addHeader(headerOf(2));
    EXPECT_EQ(detector.result().revision, Revision::Unknown);
}

TEST(Detector, TakesDeprecatedTypesForRevisionE) {
    Detector detector;
    detector.addHeader(headerOf(10));
    EXPECT_EQ(detector.result().revision, Revision::E);
}

TEST(Detector, TakesNewTypesWithReservedHeaderForRevisionJOrK) {
    Detector detector;
    detector.addHeader(headerOf(10));
    detector.addHeader(headerOf(13));
    EXPECT_EQ(detector.result().revision, Revision::JOrK);
}

TEST(Detector, LetsHeaderCountsOutweighTheTypes) {
    Detector detector;
    wire::Header header = headerOf(2);
    header.bodySegments = 23;
    header.payloadSize = 736;
    detector.addHeader(header);
    detector.addHeader(headerOf(10));
    EXPECT_EQ(detector.result().revision, Revision::N);
    EXPECT_FALSE(detector.result().revisionEvidence.empty());
}

TEST(Detector, TellsMetresFromCentimetresByThePelvis) {
    Detector metres;
    metres.addPelvisHeight(0.0);
    EXPECT_TRUE(metres.result().unitEvidence.empty());
    metres.addPelvisHeight(1.05);
    EXPECT_EQ(metres.result().positionUnit, LengthUnit::Metre);
    EXPECT_EQ(metres.result().unitEvidence, "pelvis at 1.05");

    Detector centimetres;
    centimetres.addPelvisHeight(104.8);
    EXPECT_EQ(centimetres.result().positionUnit, LengthUnit::Centimetre);
}

} // namespace
} // namespace posewire::model
