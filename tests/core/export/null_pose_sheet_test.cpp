// SPDX-License-Identifier: MIT
#include "core/export/sheets.h"

#include "core/model/body/null_pose.h"
#include "core/model/body/spaces.h"
#include "tests/core/export/csv_rows.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>

namespace posewire::exporting {
namespace {

using Strings = std::vector<std::string>;

model::NullPose oddPose() {
    model::NullPose pose;
    std::uint32_t bits = 0x3f000001;
    for (int i = 0; i < 200; ++i) {
        bits = bits * 1664525U + 1013904223U;
        const float value = std::bit_cast<float>(bits);
        pose.segments.push_back({"S", model::toVector({std::isfinite(value) ? value : 0.1F, 0.1F, -1e-30F})});
    }
    pose.points.push_back({1, 13, "pSacrum", 0x80000005U, model::toVector({-0.078F, 0, 0.027F})});
    pose.partsReceived = 2;
    pose.partsExpected = 3;
    pose.stamp = log::stampOf(1'700'000'000'123'456'789);
    pose.packet = 42;
    return pose;
}

TEST(NullPoseSheet, CsvReadsBackToTheSameFloats) {
    const model::NullPose pose = oddPose();
    const auto rows = rowsOf(nullPoseCsv({"", &pose, nullptr, nullptr}));
    ASSERT_EQ(rows.size(), 1 + pose.segments.size() + pose.points.size());
    for (std::size_t i = 0; i < pose.segments.size(); ++i) {
        const Strings& row = rows[i + 1];
        ASSERT_EQ(row.size(), rows[0].size());
        EXPECT_EQ(row[1], std::to_string(i + 1));
        const auto floats = model::toFloats(pose.segments[i].position);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(std::bit_cast<std::uint32_t>(std::strtof(row[5 + axis].c_str(), nullptr)),
                      std::bit_cast<std::uint32_t>(floats[axis]));
        }
    }
    EXPECT_EQ(rows.back()[0], "point");
    EXPECT_EQ(rows.back()[4], "0x80000005");
}

TEST(NullPoseSheet, JsonReadsBackToTheSameFloats) {
    const model::NullPose pose = oddPose();
    const auto object = nlohmann::json::parse(
        nullPoseJson({"Mira", &pose, nullptr, nullptr, log::WallTime(log::Duration(5))}));
    EXPECT_EQ(object["character"], "Mira");
    EXPECT_EQ(object["stampNs"], 5);
    EXPECT_EQ(object["partsExpected"], 3);
    for (std::size_t i = 0; i < pose.segments.size(); ++i) {
        const auto floats = model::toFloats(pose.segments[i].position);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(std::bit_cast<std::uint32_t>(object["segments"][i]["position"][axis].get<float>()),
                      std::bit_cast<std::uint32_t>(floats[axis]));
        }
    }
    EXPECT_EQ(object["points"][0]["flags"], 0x80000005U);
    EXPECT_FALSE(object.contains("scale"));
}

TEST(NullPoseSheet, QuotesNamesThatWouldBreakTheTable) {
    model::NullPose pose;
    pose.segments = {{"a,\"b\"\nc", {0, 0, 0}}};
    EXPECT_NE(nullPoseCsv({"", &pose, nullptr, nullptr}).find("segment,1,,\"a,\"\"b\"\"␊c\",,0,0,0,,,"),
              std::string::npos);
}

TEST(NullPoseSheet, WritesTypes10And11) {
    wire::ScaleInformation scale;
    scale.segments.push_back({7, {1, 2, 3}, {1, 0, 0, 0, 1, 0, 0, 0, 0.5F}});
    wire::PropInformation props;
    props.props.push_back({24, "Sword"});
    const NullPoseSheet sheet{"Mira", nullptr, &scale, &props};
    const auto rows = rowsOf(nullPoseCsv(sheet));
    ASSERT_EQ(rows.size(), 3U);
    EXPECT_EQ(rows[1], (Strings{"scale", "7", "", "", "", "1", "2", "3", "1", "0", "0", "0", "1", "0", "0",
                                "0", "0.5"}));
    EXPECT_EQ(rows[2][3], "Sword");
    EXPECT_EQ(rows[2].size(), rows[0].size());
    const auto object = nlohmann::json::parse(nullPoseJson(sheet));
    EXPECT_FALSE(object.contains("segments"));
    EXPECT_EQ(object["scale"][0]["matrix"][8], 0.5);
    EXPECT_EQ(object["props"][0]["name"], "Sword");
}

TEST(NullPoseSheet, WhatIsNoNumberIsNamed) {
    model::NullPose pose;
    pose.segments = {{"S", Eigen::Vector3d(std::nan(""), -INFINITY, INFINITY)}};
    const auto rows = rowsOf(nullPoseCsv({"", &pose, nullptr, nullptr}));
    EXPECT_EQ(rows[1][5], "NaN");
    EXPECT_EQ(rows[1][6], "-Infinity");
    const auto object = nlohmann::json::parse(nullPoseJson({"", &pose, nullptr, nullptr}));
    EXPECT_EQ(object["segments"][0]["position"][2], "Infinity");
}

} // namespace
} // namespace posewire::exporting
