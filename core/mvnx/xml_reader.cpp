// SPDX-License-Identifier: MIT
#include "core/mvnx/xml_reader.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <span>

namespace posewire::mvnx {
namespace {

constexpr std::string_view kSpaces = " \t\r\n";
constexpr std::size_t kLongestTagName = 128;

bool isSpace(int character) {
    return character > 0 && kSpaces.find(static_cast<char>(character)) != std::string_view::npos;
}

bool isOfName(int character) {
    return character > ' ' &&
           std::string_view("<>/='\"&;!?").find(static_cast<char>(character)) == std::string_view::npos;
}

void appendUtf8(std::uint32_t code, std::string& text) {
    const auto add = [&text](std::uint32_t byte) { text += static_cast<char>(byte); };
    const auto tail = [&](unsigned shift) { add(0x80U | ((code >> shift) & 0x3fU)); };
    if (code < 0x80) {
        add(code);
    } else if (code < 0x800) {
        add(0xc0U | (code >> 6U));
        tail(0);
    } else if (code < 0x10000) {
        add(0xe0U | (code >> 12U));
        tail(6);
        tail(0);
    } else {
        add(0xf0U | (code >> 18U));
        tail(12);
        tail(6);
        tail(0);
    }
}

} // namespace

tl::expected<XmlReader::Event, log::FileError> XmlReader::next() {
    const auto answer = [this](Event event, bool isRead) -> tl::expected<Event, log::FileError> {
        return isRead ? tl::expected<Event, log::FileError>(event) : tl::unexpected(m_result.error());
    };
    m_text.clear();
    if (!m_result) {
        return tl::unexpected(m_result.error());
    }
    if (m_endsAtOnce) {
        m_endsAtOnce = false;
        m_open.pop_back();
        return Event::End;
    }
    while (true) {
        const int character = take();
        if (character == '<' && peek() == '/') {
            return answer(Event::End, readEnd());
        }
        if (character == '<' && (peek() == '!' || peek() == '?')) {
            if (!skipDeclaration()) {
                return tl::unexpected(m_result.error());
            }
        } else if (character == '<') {
            return answer(Event::Begin, readBegin());
        } else if (character == kEnd) {
            const bool isWhole = m_result && m_open.empty() && m_hasRoot;
            return answer(Event::EndOfFile,
                          isWhole || fail({m_source.name() + ": is cut off: it ends in line " +
                                               std::to_string(m_line) + " amidst an element",
                                           log::FileError::Kind::Cut}));
        } else if (m_open.empty() ? !isSpace(character) && character < 0x80 : m_text.size() >= kLongest) {
            failAt(m_open.empty() ? "a text outside of all elements" : "a text that is too long");
            return tl::unexpected(m_result.error());
        } else if (character == '&') {
            if (!readReference(m_text)) {
                return tl::unexpected(m_result.error());
            }
        } else if (!m_open.empty()) {
            m_text += static_cast<char>(character);
        }
    }
}

std::string_view XmlReader::attribute(std::string_view name) const {
    const auto found = std::find_if(m_attributes.begin(), m_attributes.end(),
                                    [name](const auto& attribute) { return attribute.first == name; });
    return found == m_attributes.end() ? std::string_view() : found->second;
}

log::FileError XmlReader::damage(const std::string& problem) const {
    return {m_source.name() + ": line " + std::to_string(m_line) + ": " + problem +
                "; export the file from MVN again",
            log::FileError::Kind::Damaged};
}

int XmlReader::peek() {
    if (m_at == m_size) {
        const auto count = m_result ? m_source.read(m_buffer) : 0;
        if (!count) {
            fail(count.error());
        }
        m_at = 0;
        m_size = count.value_or(0);
    }
    return m_at < m_size ? std::to_integer<int>(m_buffer[m_at]) : kEnd;
}

int XmlReader::take() {
    const int character = peek();
    m_at += character == kEnd ? 0 : 1;
    m_line += character == '\n' ? 1 : 0;
    return character;
}

bool XmlReader::takeUntil(std::string_view end, std::string* into) {
    std::string last;
    while (last != end) {
        const int character = take();
        if (character == kEnd) {
            return failAt("the file ends before \"" + std::string(end) + "\"");
        }
        if (last.size() == end.size()) {
            if (into != nullptr) {
                *into += last.front();
            }
            last.erase(0, 1);
        }
        last += static_cast<char>(character);
        if (into != nullptr && into->size() > kLongest) {
            return failAt("a text that is too long");
        }
    }
    return true;
}

/// Behind "<", at "!" or "?".
bool XmlReader::skipDeclaration() {
    if (take() == '?') {
        return takeUntil("?>", nullptr);
    }
    std::string start;
    while (peek() != kEnd && peek() != '>' && start != "--" && start != "[CDATA[" && start.size() < 8) {
        start += static_cast<char>(take());
    }
    if (start == "--") {
        return takeUntil("-->", nullptr);
    }
    if (start == "[CDATA[" && !m_open.empty()) {
        return takeUntil("]]>", &m_text);
    }
    if (start != "DOCTYPE ") {
        return failAt("\"<!" + start + "\" where an element should be");
    }
    for (int character = take(); character != '>'; character = take()) {
        if (character == '[' || character == kEnd) {
            return failAt("a document type with declarations of its own, which MVNX does not have");
        }
    }
    return true;
}

bool XmlReader::readBegin() {
    m_attributes.clear();
    m_name.clear();
    if (m_open.empty() && m_hasRoot) {
        return failAt("a second document behind the first");
    }
    if (m_open.size() == kDeepest) {
        return failAt("elements more than " + std::to_string(kDeepest) + " deep in each other");
    }
    if (!readName(m_name)) {
        return false;
    }
    for (skipSpace(); peek() != '>' && peek() != '/'; skipSpace()) {
        if (!readAttribute()) {
            return false;
        }
    }
    m_endsAtOnce = peek() == '/';
    if (m_endsAtOnce) {
        take();
    }
    if (take() != '>') {
        return failAt("the tag of \"" + m_name + "\" does not end");
    }
    m_open.push_back(m_name);
    m_hasRoot = true;
    return true;
}

bool XmlReader::readAttribute() {
    auto& [name, value] = m_attributes.emplace_back();
    if (m_attributes.size() > kMostAttributes) {
        return failAt("an element with too many attributes");
    }
    if (!readName(name)) {
        return false;
    }
    skipSpace();
    const bool hasValue = take() == '=';
    skipSpace();
    const int quote = take();
    if (!hasValue || (quote != '"' && quote != '\'')) {
        return failAt("the attribute \"" + name + "\" has no value in quotes");
    }
    for (int character = take(); character != quote; character = take()) {
        if (character == kEnd || character == '<' || value.size() >= kLongest) {
            return failAt("the attribute \"" + name + "\" does not end");
        }
        if (character != '&') {
            value += static_cast<char>(character);
        } else if (!readReference(value)) {
            return false;
        }
    }
    return true;
}

/// Behind "<", at "/".
bool XmlReader::readEnd() {
    take();
    m_name.clear();
    if (!readName(m_name)) {
        return false;
    }
    skipSpace();
    if (take() != '>' || m_open.empty() || m_open.back() != m_name) {
        return failAt("\"</" + m_name + ">\" ends what " +
                      (m_open.empty() ? "was not begun" : "began as <" + m_open.back() + ">"));
    }
    m_open.pop_back();
    return true;
}

/// A prefix is left out.
bool XmlReader::readName(std::string& into) {
    while (isOfName(peek())) {
        into += static_cast<char>(take());
        if (into.back() == ':') {
            into.clear();
        }
        if (into.size() > kLongestTagName) {
            return failAt("a name that is too long");
        }
    }
    return !into.empty() || failAt("a name is missing");
}

/// Behind "&".
bool XmlReader::readReference(std::string& into) {
    constexpr std::array<std::pair<std::string_view, char>, 5> kKnown{
        {{"amp", '&'}, {"lt", '<'}, {"gt", '>'}, {"quot", '"'}, {"apos", '\''}}};
    std::string name;
    while (peek() != kEnd && peek() != ';' && name.size() < 16) {
        name += static_cast<char>(take());
    }
    const auto* const known = std::find_if(kKnown.begin(), kKnown.end(),
                                           [&name](const auto& entity) { return entity.first == name; });
    if (take() == ';' && known != kKnown.end()) {
        into += known->second;
        return true;
    }
    const bool isHex = name.starts_with("#x");
    const std::string_view digits =
        std::string_view(name).substr(std::min<std::size_t>(isHex ? 2 : 1, name.size()));
    std::uint32_t code = 0;
    const auto parsed = std::from_chars(digits.data(), digits.data() + digits.size(), code, isHex ? 16 : 10);
    const bool isCode = name.starts_with('#') && parsed.ec == std::errc() &&
                        parsed.ptr == digits.data() + digits.size() && code != 0 && code < 0x110000 &&
                        (code < 0xd800 || code > 0xdfff);
    if (!isCode) {
        return failAt("\"&" + name + ";\" is not defined");
    }
    appendUtf8(code, into);
    return true;
}

void XmlReader::skipSpace() {
    while (isSpace(peek())) {
        take();
    }
}

bool XmlReader::fail(log::FileError error) {
    if (m_result) {
        m_result = tl::unexpected(std::move(error));
    }
    return false;
}

} // namespace posewire::mvnx
