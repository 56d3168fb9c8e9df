// SPDX-License-Identifier: MIT
#include "core/model/body/body_measure.h"

#include "core/model/body/segments.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace posewire::model {
namespace {

/// Where the segments of a body of 120 % are.
wire::Datagram positions() {
    wire::LinearKinematics message;
    for (std::uint32_t i = 0; i < kBodySegmentCount; ++i) {
        const Eigen::Vector3d place = 1.2 * referenceOrigins()[i];
        message.segments.push_back(
            {i + 1,
             {static_cast<float>(place.x()), static_cast<float>(place.y()), static_cast<float>(place.z())},
             {},
             {}});
    }
    wire::Datagram datagram{{}, std::move(message), {}};
    datagram.header.datagramCounter = 0x80;
    return datagram;
}

BodyOrigins measured(const wire::Datagram& datagram) {
    BodyMeasure measure;
    measure.add(datagram, LengthUnit::Metre);
    return measure.body().value_or(BodyOrigins{});
}

TEST(BodyMeasure, TakesPositionsForTheSegmentsOfTheirIds) {
    const BodyOrigins body = measured(positions());
    EXPECT_NEAR(body.places[segment::kHead].z() - body.places[segment::kNeck].z(),
                1.2 * (referenceOrigins()[segment::kHead] - referenceOrigins()[segment::kNeck]).z(), 1e-4);
    wire::Datagram reversed = positions();
    std::ranges::reverse(std::get<wire::LinearKinematics>(reversed.body).segments);
    const BodyOrigins same = measured(reversed);
    for (std::size_t i = 0; i < kBodySegments; ++i) {
        EXPECT_TRUE(same.places[i].isApprox(body.places[i]) || body.places[i].norm() < 1e-6) << i;
    }
}

TEST(BodyMeasure, TakesNothingOfABodyThatLacksSegments) {
    wire::Datagram datagram = positions();
    auto& segments = std::get<wire::LinearKinematics>(datagram.body).segments;
    segments[3].id = 5; // twice, and the fourth not at all
    BodyMeasure measure;
    measure.add(datagram, LengthUnit::Metre);
    EXPECT_FALSE(measure.body());
    EXPECT_EQ(measure.version(), 0U);
}

} // namespace
} // namespace posewire::model
