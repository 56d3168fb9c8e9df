// SPDX-License-Identifier: MIT
#pragma once

#include "core/log/byte_io.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace posewire::mvnx {

/// Reads XML in UTF-8 piece by piece: elements, attributes and text; comments and processing instructions are
/// skipped. It knows the five entities of XML and characters by number, no others, and opens no other file. A
/// tag, a text and the depth of elements are bounded, so memory does not grow with the file.
class XmlReader {
public:
    enum class Event : std::uint8_t { Begin, End, EndOfFile };

    static constexpr std::size_t kDeepest = 32;                     ///< elements within each other
    static constexpr std::size_t kLongest = std::size_t{256} << 10; ///< bytes of a tag or a text
    static constexpr std::size_t kMostAttributes = 64;

    /// `source` outlives this.
    explicit XmlReader(log::ByteSource& source) : m_source(source) {}

    /// Goes on to the next tag. Fails with FileError::Kind::Cut if the file ends within an element, with
    /// Damaged and the line if it is no such XML.
    tl::expected<Event, log::FileError> next();

    // Valid until the next call.
    [[nodiscard]] std::string_view name() const { return m_name; } ///< of the element, without a prefix
    [[nodiscard]] std::string_view text() const { return m_text; } ///< between the last tag and this one
    /// Empty if the element has none of that name.
    [[nodiscard]] std::string_view attribute(std::string_view name) const;
    [[nodiscard]] std::size_t depth() const { return m_open.size(); } ///< elements that are open

    [[nodiscard]] std::size_t line() const { return m_line; } ///< from 1
    /// "take.mvnx: line 12: …": all before it was read.
    [[nodiscard]] log::FileError damage(const std::string& problem) const;

private:
    using Result = tl::expected<void, log::FileError>;
    static constexpr int kEnd = -1;

    int peek();
    int take();
    /// Appends what comes before `end` to `into`, which may be null, and takes `end` too.
    bool takeUntil(std::string_view end, std::string* into);
    bool skipDeclaration();
    bool readBegin();
    bool readEnd();
    bool readAttribute();
    bool readName(std::string& into);
    bool readReference(std::string& into);
    void skipSpace();
    /// Always false. Keeps the first failure.
    bool fail(log::FileError error);
    bool failAt(const std::string& problem) { return fail(damage(problem)); }

    log::ByteSource& m_source;
    std::vector<std::byte> m_buffer = std::vector<std::byte>(std::size_t{64} << 10);
    std::size_t m_at = 0;
    std::size_t m_size = 0;
    std::size_t m_line = 1;
    bool m_endsAtOnce = false; ///< the element was written as <name/>
    bool m_hasRoot = false;
    std::string m_name;
    std::string m_text;
    std::vector<std::pair<std::string, std::string>> m_attributes;
    std::vector<std::string> m_open;
    Result m_result;
};

} // namespace posewire::mvnx
