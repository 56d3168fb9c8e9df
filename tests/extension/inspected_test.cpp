// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/gui/models/field_text.h"
#include "tests/support/golden.h"
#include "tests/support/paths.h"

#include <gtest/gtest.h>

namespace posewire::gui {
namespace {

TEST(FurtherMessage, IsInspected) {
    const auto bytes = test::readHexadecimal(test::sourcePath("tests/extension/26_probes.hex"));
    const FieldDocument document(log::Packet{7, {}, {}, 0, {}, bytes}, model::LengthUnit::Metre);
    EXPECT_EQ(documentTitle(document), "26 Probes");
    EXPECT_TRUE(document.problems.empty());
    const std::int32_t item = document.find("readings[1]");
    ASSERT_GE(item, 0);
    EXPECT_EQ(fieldTitle(document, item), QStringLiteral("Segment 22 · Left Foot"));
    const std::int32_t level = document.find("readings[0].level");
    EXPECT_EQ(wireValue(document, level), "-2");
    EXPECT_EQ(fieldPlace(document, level), QStringLiteral("int32 at bytes 46–49"));
    const std::int32_t temperature = document.find("readings[0].temperature");
    EXPECT_EQ(fieldPlace(document, temperature), QStringLiteral("float32 at bytes 30–33"));
    EXPECT_EQ(convertedValue(document, document.find("readings[0].wind")),
              QStringLiteral("1.000  −1.500  0.250 m/s"));
}

} // namespace
} // namespace posewire::gui
