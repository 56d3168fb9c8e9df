// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/log/byte_io.h"

#include <QXmlStreamReader>

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace posewire::mvnx {

/// Reads XML piece by piece, by QXmlStreamReader: elements, attributes and text. A tag, a text and the depth
/// of elements are bounded, so memory does not grow with the file; document types with entities of their own
/// are refused.
class XmlReader {
public:
    enum class Event : std::uint8_t { Begin, End, EndOfFile };

    static constexpr int kDeepest = 32;                             ///< elements within each other
    static constexpr std::size_t kLongest = std::size_t{256} << 10; ///< bytes of a tag or a text

    /// Reads `head`, then `source`, which outlives this.
    XmlReader(std::string_view head, log::ByteSource& source) : m_source(source) {
        m_xml.setNamespaceProcessing(false);
        m_xml.addData(QByteArray(head.data(), static_cast<qsizetype>(head.size())));
    }

    /// Goes on to the next tag. Fails with FileError::Kind::Cut if the file ends within an element, with
    /// Damaged and the line if it is no such XML.
    tl::expected<Event, log::FileError> next();

    // Valid until the next call.
    [[nodiscard]] std::string_view name() const { return m_name; } ///< of the element, without a prefix
    [[nodiscard]] std::string_view text() const { return m_text; } ///< between the last tag and this one
    /// Empty if the element has none of that name.
    [[nodiscard]] std::string_view attribute(std::string_view name) const;

    /// "take.mvnx: line 12: …": all before it was read.
    [[nodiscard]] log::FileError damage(const std::string& problem) const;

private:
    tl::expected<void, log::FileError> readMore();

    log::ByteSource& m_source;
    QXmlStreamReader m_xml;
    std::vector<std::byte> m_buffer = std::vector<std::byte>(std::size_t{16} << 10);
    std::size_t m_fed = 0; ///< bytes since the last token
    int m_depth = 0;
    std::string m_name;
    std::string m_text;
    std::vector<std::pair<std::string, std::string>> m_attributes;
};

} // namespace posewire::mvnx
