// SPDX-License-Identifier: MIT
#include "core/export/json.h"

#include "core/export/json_fields.h"
#include "core/export/json_value.h"
#include "core/model/body/item_names.h"
#include "core/wire/codec.h"
#include "core/wire/form.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"
#include "core/wire/walk.h"
#include "core/words/say.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <concepts>
#include <functional>
#include <span>

namespace posewire::exporting {
namespace {

/// An object while it is written, without its last brace.
struct Line {
    /// A part of the text that can be asked for, with its key: "body", "body.segments".
    struct Member {
        std::string name;
        std::size_t begin = 0;
        std::size_t end = 0;
    };

    std::string text;
    bool isOdd = false;                    ///< of what is written the bytes may not follow
    std::span<const std::string> fields{}; ///< those asked for; none: all
    std::vector<Member> members{};         ///< if fields are asked for
    int depth = 0;                         ///< 1 within the body

    void add(std::string_view words) { text += words; }
    /// A key and its value.
    void member(std::string_view name, auto&& writeValue) {
        text += text.back() == '{' || text.back() == '[' ? "\"" : ",\"";
        text.append(name).append("\":");
        const std::size_t begin = text.size();
        ++depth;
        writeValue();
        --depth;
        if (!fields.empty() && depth < 2) {
            members.push_back({(depth == 0 ? "" : "body.") + std::string(name), begin, text.size()});
        }
    }
    [[nodiscard]] bool wants(std::string_view name) const {
        return fields.empty() || std::ranges::any_of(fields, [name](const std::string& field) {
                   return field.starts_with(name) &&
                          (field.size() == name.size() || field[name.size()] == '.');
               });
    }
    /// Returns the whole object, or of it the fields asked for, in their order.
    [[nodiscard]] std::string finished() && {
        if (fields.empty()) {
            return std::move(text) + '}';
        }
        std::string chosen = "{";
        for (const std::string& field : fields) {
            const auto found = std::ranges::find(members, field, &Member::name);
            if (found != members.end()) {
                chosen.append(chosen.size() > 1 ? ",\"" : "\"").append(field).append("\":");
                chosen.append(text, found->begin, found->end - found->begin);
            }
        }
        return chosen + '}';
    }
};

/// Room for any float.
constexpr std::size_t kFloatRoom = 24;

/// As documents are dumped, to the last digit. Where no shorter number is as near as another one (a float
/// that ends in other bits than zeros, and is small enough) the standard library finds the same in half the
/// time.
char* put(float value, char* to, Line& line) {
    constexpr float kLeastFixed = 1e-4F;
    constexpr float kMostFixed = 1024;
    constexpr std::uint32_t kLowBits = 0xff;
    const float size = std::abs(value);
    if (size >= kLeastFixed && size < kMostFixed && (std::bit_cast<std::uint32_t>(value) & kLowBits) != 0) {
        return std::to_chars(to, to + kFloatRoom, value, std::chars_format::fixed).ptr;
    }
    if (std::isfinite(value)) {
        return nlohmann::detail::to_chars(to, to + kFloatRoom, value);
    }
    line.isOdd = line.isOdd || std::isnan(value);
    return std::ranges::copy('"' + numberText(value) + '"', to).out;
}

void append(Line& line, std::same_as<float> auto value) {
    std::array<char, kFloatRoom> digits{};
    line.text.append(digits.data(), put(value, digits.data(), line));
}

void append(Line& line, std::integral auto value) {
    std::array<char, 24> digits{};
    line.text.append(digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr);
}

void append(Line& line, bool value) {
    line.add(value ? "true" : "false");
}

/// Text that is not UTF-8 cannot be in JSON: each byte out of place becomes a question mark.
void append(Line& line, std::string text) {
    for (std::size_t bad = 0; (bad = wire::firstInvalidUtf8(text)) != text.size();) {
        text[bad] = '?';
    }
    line.add(Json(std::move(text)).dump());
}

template <std::size_t N>
void append(Line& line, const std::array<char, N>& characters) {
    append(line, std::string(characters.data(), N));
}

template <std::size_t N>
void append(Line& line, const std::array<float, N>& values) {
    std::array<char, N*(kFloatRoom + 1) + 1> numbers;
    char* to = numbers.data();
    for (const float value : values) {
        *to = to == numbers.data() ? '[' : ',';
        to = put(value, to + 1, line);
    }
    *to++ = ']';
    line.text.append(numbers.data(), static_cast<std::size_t>(to - numbers.data()));
}

void appendTags(Line& line, const std::string& text) {
    Json tags = Json::array();
    for (const wire::Tag& tag : wire::parseTags(text).tags) {
        tags.push_back(Json::array({std::string(tag.name), std::string(tag.value)}));
    }
    line.add(tags.dump());
}

using ItemName = std::function<std::string_view(std::size_t item)>;

/// The fields of a message or an item, between their braces; items of the first list with their names.
template <class T, wire::Form F>
void appendFields(Line& line, const T& value, const ItemName& nameOf = {}) {
    line.text += '{';
    wire::forEachField<T, F>([&]<class FieldType>(const FieldType& field) {
        const auto& member = value.*FieldType::kMember;
        if constexpr (requires { FieldType::kItemForm; }) {
            const bool isNamed = nameOf && line.text.back() == '{';
            line.member(field.about.name, [&] {
                line.text += '[';
                line.isOdd = line.isOdd || member.empty();
                for (std::size_t i = 0; i < member.size(); ++i) {
                    line.add(i == 0 ? "" : ",");
                    appendFields<typename FieldType::Item, FieldType::kItemForm>(line, member[i]);
                    if (const std::string_view name = isNamed ? nameOf(i) : ""; !name.empty()) {
                        line.text.back() = ',';
                        line.text.append("\"name\":\"").append(name).append("\"}");
                    }
                }
                line.text += ']';
            });
        } else if constexpr (requires { FieldType::kKind; }) {
            const bool isTags = field.about.unit == wire::Unit::TagLines;
            line.isOdd = true;
            line.member(isTags ? kTagsKey : field.about.name,
                        [&] { isTags ? appendTags(line, member) : append(line, member); });
        } else if (!isLength(field.about)) {
            line.isOdd = line.isOdd || field.about.unit == wire::Unit::TimeOfDay;
            line.member(field.about.name, [&] { append(line, member); });
        }
    });
    line.text += '}';
}

/// Adds the header's fields as far as they could be read.
class HeaderToJson : public wire::SilentVisitor {
public:
    explicit HeaderToJson(Line& to) : m_line(to) {}

    template <class Value>
    void field(const wire::About& about, std::size_t, std::size_t, const Value& value) {
        if constexpr (std::integral<Value>) {
            m_line.isOdd = m_line.isOdd || (about.unit == wire::Unit::Reserved && value != 0);
        }
        if (about.parts.empty() && about.unit != wire::Unit::Reserved) {
            m_line.member(about.name, [&] { append(m_line, value); });
        }
        for (const wire::FieldPart& part : about.parts) {
            if (!part.key.empty()) {
                m_line.member(part.key, [&] { appendPart(part, value); });
            }
        }
    }

private:
    template <std::size_t N>
    void appendPart(const wire::FieldPart& part, const std::array<char, N>& characters) {
        append(m_line, std::string(characters.data() + part.offset, part.size));
    }
    void appendPart(const wire::FieldPart& part, std::unsigned_integral auto value) {
        const unsigned bits = value & part.bits;
        part.isFlag() ? append(m_line, bits != 0) : append(m_line, bits);
    }

    Line& m_line;
};

void appendHeader(Line& line, wire::Bytes bytes) {
    const auto read = wire::decodeHeader(bytes);
    const bool isCut = !read && read.error().code == wire::ErrorCode::HeaderTruncated;
    if ((!read && !isCut) || !wire::startsDatagram(bytes)) {
        return;
    }
    wire::Header header;
    wire::Cursor cursor{bytes.first(std::min(bytes.size(), wire::kHeaderSize)), 0, 0, {}};
    HeaderToJson visitor(line);
    wire::readLayout<wire::Header, wire::Form::Standard>(cursor, header, visitor);
}

void appendBody(Line& line, const wire::Datagram& datagram, bool hasNames) {
    const ItemName nameOf =
        hasNames ? [&](std::size_t item) { return model::itemName(datagram, item); } : ItemName();
    line.member("body", [&] {
        if (const auto* raw = std::get_if<wire::RawBody>(&datagram.body)) {
            line.isOdd = true;
            line.text += '{';
            line.member("raw", [&] { line.add('"' + wire::hexadecimal(raw->bytes) + '"'); });
            line.text += '}';
        }
        wire::visitMessage(datagram.body, [&]<wire::Form F, class T>(const T& message) {
            appendFields<T, F>(line, message, nameOf);
        });
    });
}

Line placed(const DatagramPlace& place, std::uint64_t size, std::size_t room,
            std::span<const std::string> fields) {
    Line line{.text = "{", .fields = fields};
    line.text.reserve(room);
    line.member("index", [&] { append(line, place.index); });
    line.member("offset", [&] { append(line, place.offset); });
    line.member("size", [&] { append(line, size); });
    return line;
}

void appendError(Line& line, const wire::WireError& error) {
    const Json object{{"code", std::string(wire::errorName(error.code))},
                      {"offset", error.offset},
                      {"need", error.need},
                      {"have", error.have},
                      {"text", wire::errorText(error)}};
    line.member("error", [&] { line.add(object.dump()); });
}

void appendNotices(Line& line, const DatagramPlace& place, const wire::Datagram& datagram) {
    Json notices = Json::array();
    for (const wire::Notice& notice : datagram.notices) {
        notices.push_back(wire::noticeText(notice));
    }
    if (place.shared != 0) {
        notices.push_back(say(words::sharedFact(place.shared), words::Form::Sentence));
    }
    line.member("notices", [&] { line.add(notices.dump()); });
}

/// True if the line gives back the bytes. One that is not odd need not be read for that: its values are
/// encoded.
bool givesBack(const Line& line, const wire::Datagram& datagram, wire::Bytes bytes) {
    static thread_local std::vector<std::byte> encoded; // its memory is reused
    if (!line.isOdd) {
        return wire::encodeInto(datagram, encoded) && std::ranges::equal(encoded, bytes);
    }
    const auto again = datagramFromJson(line.text + '}');
    return again && std::ranges::equal(*again, bytes);
}

} // namespace

std::string datagramJson(const DatagramPlace& place, wire::Bytes bytes, const JsonChoice& choice) {
    constexpr std::size_t kRoom = 512;
    static thread_local wire::Datagram datagram; // its memory is reused: no allocation for each datagram
    Line line = placed(place, bytes.size(), kRoom + 5 * bytes.size(), choice.fields);
    line.member("stampNs",
                [&] { line.add(place.time ? std::to_string(log::nanosecondsOf(*place.time)) : "null"); });
    line.member("source", [&] { place.sender ? append(line, *place.sender) : line.add("null"); });
    appendHeader(line, bytes);
    if (const auto decoded = wire::decodeInto(bytes, datagram); !decoded) {
        appendError(line, decoded.error());
        line.member("notices", [&line] { line.add("[]"); });
        return std::move(line).finished();
    }
    const bool isWhole = line.wants("bytes");
    if (isWhole || line.wants("body")) {
        appendBody(line, datagram, choice.hasNames);
    }
    appendNotices(line, place, datagram);
    if (isWhole && !givesBack(line, datagram, bytes)) {
        line.member("bytes", [&] { line.add('"' + wire::hexadecimal(bytes) + '"'); });
    }
    return std::move(line).finished();
}

std::string skippedJson(const DatagramPlace& place, std::uint64_t size, const JsonChoice& choice) {
    constexpr std::size_t kRoom = 96;
    Line line = placed(place, size, kRoom, choice.fields);
    line.member("skipped", [&line] { append(line, true); });
    return std::move(line).finished();
}

std::vector<std::string> jsonFields() {
    std::vector<std::string> names{"index", "offset", "size", "stampNs", "source"};
    for (const wire::FieldRow& row : wire::headerRows()) {
        if (row.about.parts.empty() && row.about.unit != wire::Unit::Reserved) {
            names.emplace_back(row.about.name);
        }
        for (const wire::FieldPart& part : row.about.parts) {
            if (!part.key.empty()) {
                names.emplace_back(part.key);
            }
        }
    }
    names.insert(names.end(), {"notices", "bytes", "error", "skipped", "body", "body.raw"});
    for (const wire::TypeInfo& type : wire::typeTable()) {
        for (const wire::FieldRow& row : type.fields()) {
            const bool isTags = row.about.unit == wire::Unit::TagLines;
            std::string name = "body." + std::string(isTags ? kTagsKey : row.about.name);
            if (!isLength(row.about) && std::ranges::find(names, name) == names.end()) {
                names.push_back(std::move(name));
            }
        }
    }
    return names;
}

} // namespace posewire::exporting
