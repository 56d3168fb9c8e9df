// SPDX-License-Identifier: MIT
#include "core/export/null_pose_sheet.h"

#include "core/export/csv.h"
#include "core/model/body/spaces.h"

#include <array>
#include <charconv>
#include <cmath>
#include <span>
#include <string_view>

namespace posewire::exporting {
namespace {

constexpr std::string_view kHeader =
    "kind,segment,point,name,flags,x,y,z,m11,m12,m13,m21,m22,m23,m31,m32,m33\r\n";
constexpr std::size_t kColumns = 17;

std::string numberText(float value) {
    if (std::isnan(value)) {
        return "NaN";
    }
    if (std::isinf(value)) {
        return value > 0 ? "Infinity" : "-Infinity";
    }
    std::array<char, 32> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
    return {digits.data(), end};
}

std::string flagsText(std::uint32_t flags) {
    constexpr std::string_view kDigits = "0123456789abcdef";
    std::string text = "0x00000000";
    for (std::size_t i = 0; i < 8; ++i) {
        text[9 - i] = kDigits[flags >> (4 * i) & 0xfU];
    }
    return text;
}

/// A line whose cells are filled from the left; the rest is empty.
class Row {
public:
    explicit Row(std::string kind) { m_cells[0] = std::move(kind); }

    Row& cell(std::string text) {
        m_cells[++m_last] = std::move(text);
        return *this;
    }
    Row& empty() { return cell(""); }
    Row& cells(std::span<const float> values) {
        for (const float value : values) {
            cell(numberText(value));
        }
        return *this;
    }
    [[nodiscard]] std::string line() const { return csvLine(m_cells); }

private:
    std::array<std::string, kColumns> m_cells;
    std::size_t m_last = 0;
};

void addPose(const model::NullPose& pose, std::string& text) {
    int id = 0;
    for (const auto& segment : pose.segments) {
        Row row("segment");
        row.cell(std::to_string(++id)).empty().cell(segment.name).empty();
        text += row.cells(model::toFloats(segment.position)).line();
    }
    for (const auto& point : pose.points) {
        Row row("point");
        row.cell(std::to_string(point.segment)).cell(std::to_string(point.id)).cell(point.name);
        row.cell(flagsText(point.flags));
        text += row.cells(model::toFloats(point.position)).line();
    }
}

} // namespace

std::string nullPoseCsv(const NullPoseSheet& sheet) {
    std::string text(kHeader);
    if (sheet.pose != nullptr) {
        addPose(*sheet.pose, text);
    }
    if (sheet.scale != nullptr) {
        for (const wire::SegmentScale& segment : sheet.scale->segments) {
            Row row("scale");
            row.cell(std::to_string(segment.id)).empty().empty().empty();
            text += row.cells(segment.offset).cells(segment.matrix).line();
        }
    }
    if (sheet.props != nullptr) {
        for (const wire::Prop& prop : sheet.props->props) {
            Row row("prop");
            text += row.cell(std::to_string(prop.id)).empty().cell(prop.name).line();
        }
    }
    return text;
}

} // namespace posewire::exporting
