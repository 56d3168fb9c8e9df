// SPDX-License-Identifier: MIT
#include "core/wire/notice.h"

#include <array>
#include <cstddef>

namespace posewire::wire {
namespace {

struct NoticeRow {
    NoticeCode code;
    std::string_view name;
    std::string_view text;
    std::string_view counted; ///< what the count counts, in the plural; empty where it is always one
};

constexpr std::array<NoticeRow, kNoticeCodeCount> kNotices{{
    {NoticeCode::UnknownType, "unknownType", "message type not known, payload kept as bytes", ""},
    {NoticeCode::UnknownLayout, "unknownLayout", "type 04 in a layout that is not published, kept as bytes",
     ""},
    {NoticeCode::TrailingBytes, "trailingBytes", "bytes after the last field", "bytes"},
    {NoticeCode::SizeDisagrees, "sizeDisagrees", "longer than the payload size in the header", "bytes"},
    {NoticeCode::CountDisagrees, "countDisagrees",
     "body, props and fingers do not add up to the number of items", ""},
    {NoticeCode::ReservedUsed, "reservedUsed", "reserved header bytes are not zero", ""},
    {NoticeCode::NotFinite, "notFinite", "not a finite number", "values"},
    {NoticeCode::NotUnitQuaternion, "notUnitQuaternion", "quaternion is not of unit length", "quaternions"},
    {NoticeCode::SegmentOutOfRange, "segmentOutOfRange", "segment ID is not in 1 to 67", "segments"},
    {NoticeCode::UnknownTag, "unknownTag", "tag not known", "tags"},
    {NoticeCode::LineWithoutTag, "lineWithoutTag", "line that is not \"tag:value\"", "lines"},
    {NoticeCode::LengthDisagrees, "lengthDisagrees", "length before the time code is not 12", ""},
    {NoticeCode::NotATimeCode, "notATimeCode", "time code is not HH:MM:SS.mmm", ""},
}};

constexpr bool rowsFollowTheEnum() {
    for (std::size_t i = 0; i < kNotices.size(); ++i) {
        if (kNotices[i].code != static_cast<NoticeCode>(i)) {
            return false;
        }
    }
    return true;
}
static_assert(rowsFollowTheEnum());

} // namespace

std::string_view noticeName(NoticeCode code) {
    return kNotices[static_cast<std::size_t>(code)].name;
}

std::string noticeText(const Notice& notice) {
    const NoticeRow& row = kNotices[static_cast<std::size_t>(notice.code)];
    std::string text(row.text);
    text += " (byte " + std::to_string(notice.offset);
    if (!row.counted.empty()) {
        const std::size_t plural = notice.count == 1 ? 1 : 0; // the s
        text += ", " + std::to_string(notice.count) + ' ' +
                std::string(row.counted.substr(0, row.counted.size() - plural));
    }
    return text + ')';
}

} // namespace posewire::wire
