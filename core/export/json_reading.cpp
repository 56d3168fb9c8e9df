// SPDX-License-Identifier: MIT
#include "core/export/json_fields.h"

#include "core/wire/codec.h"
#include "core/wire/form.h"
#include "core/wire/text.h"
#include "core/wire/type_table.h"
#include "core/wire/write.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace posewire::exporting {
namespace {

using Kind = JsonFault::Kind;

/// Collects where reading went wrong, from the inside out.
struct FieldFault {
    std::string path;
    std::string text;

    bool fail(std::string what) {
        text = std::move(what);
        return false;
    }
    bool under(std::string_view key) {
        path = std::string(key) + (path.empty() || path.front() == '[' ? "" : ".") + path;
        return false;
    }
};

bool readJson(const Json& json, float& value, FieldFault& fault) {
    if (json.is_number()) {
        value = json.get<float>();
        return true;
    }
    const auto* text = json.get_ptr<const std::string*>();
    if (text != nullptr && *text == "NaN") {
        value = std::numeric_limits<float>::quiet_NaN();
    } else if (text != nullptr && *text == "Infinity") {
        value = std::numeric_limits<float>::infinity();
    } else if (text != nullptr && *text == "-Infinity") {
        value = -std::numeric_limits<float>::infinity();
    } else {
        return fault.fail("needs a number, or \"NaN\", \"Infinity\" or \"-Infinity\"");
    }
    return true;
}

template <std::size_t N>
bool readJson(const Json& json, std::array<float, N>& values, FieldFault& fault) {
    if (!json.is_array() || json.size() != N) {
        return fault.fail("needs " + std::to_string(N) + " numbers in brackets");
    }
    for (std::size_t i = 0; i < N; ++i) {
        if (!readJson(json[i], values[i], fault)) {
            return fault.under("[" + std::to_string(i) + "]");
        }
    }
    return true;
}

bool readJson(const Json& json, std::string& text, FieldFault& fault) {
    const auto* string = json.get_ptr<const std::string*>();
    if (string == nullptr) {
        return fault.fail("needs a string");
    }
    text = *string;
    return true;
}

template <std::size_t N>
bool readJson(const Json& json, std::array<char, N>& characters, FieldFault& fault) {
    const auto* string = json.get_ptr<const std::string*>();
    if (string == nullptr || string->size() != N) {
        return fault.fail("needs a string of " + std::to_string(N) + " characters");
    }
    std::copy(string->begin(), string->end(), characters.begin());
    return true;
}

template <std::integral Integer>
bool readJson(const Json& json, Integer& value, FieldFault& fault) {
    using Limits = std::numeric_limits<Integer>;
    const bool isNumber = json.is_number_integer();
    const bool isBelow = isNumber && !json.is_number_unsigned();
    const bool fits = isBelow ? std::cmp_greater_equal(json.get<std::int64_t>(), Limits::min())
                              : isNumber && std::cmp_less_equal(json.get<std::uint64_t>(), Limits::max());
    if (!fits) {
        return fault.fail("needs a whole number from " + std::to_string(Limits::min()) + " to " +
                          std::to_string(Limits::max()));
    }
    value = json.get<Integer>();
    return true;
}

bool readJson(const Json& json, bool& value, FieldFault& fault) {
    if (!json.is_boolean()) {
        return fault.fail("needs true or false");
    }
    value = json.get<bool>();
    return true;
}

/// Reads a member of an object that must be there.
template <class Value>
bool readMember(const Json& object, std::string_view key, Value& value, FieldFault& fault) {
    const auto found = object.find(std::string(key));
    const bool isThere = found != object.end();
    const bool isRead = isThere ? readJson(*found, value, fault) : fault.fail("is missing");
    return isRead || fault.under(key);
}

template <class T, wire::Form F>
bool readObject(const Json& json, T& value, FieldFault& fault);

template <wire::Form F, class Item>
bool readList(const Json& object, std::string_view key, std::vector<Item>& items, FieldFault& fault) {
    const auto list = object.find(std::string(key));
    if (list == object.end() || !list->is_array()) {
        return fault.fail("needs a list") || fault.under(key);
    }
    items.resize(list->size());
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (!readObject<Item, F>((*list)[i], items[i], fault)) {
            return fault.under("[" + std::to_string(i) + "]") || fault.under(key);
        }
    }
    return true;
}

bool readTags(const Json& object, std::string& into, FieldFault& fault) {
    const auto tags = object.find(kTagsKey);
    bool isList = tags != object.end() && tags->is_array();
    std::string text;
    for (std::size_t i = 0; isList && i < tags->size(); ++i) {
        const Json& tag = (*tags)[i];
        isList = tag.is_array() && tag.size() == 2 && tag[0].is_string() && tag[1].is_string();
        if (isList) {
            text += tag[0].get<std::string>() + ':' + tag[1].get<std::string>() + '\n';
        }
    }
    into = std::move(text);
    return isList || fault.fail("needs a list of [name, value] pairs") || fault.under(kTagsKey);
}

template <class T, wire::Form F>
bool readObject(const Json& json, T& value, FieldFault& fault) {
    if (!json.is_object()) {
        return fault.fail("needs an object in braces");
    }
    const auto read = [&]<class FieldType>(const FieldType& field) {
        auto& member = value.*FieldType::kMember;
        if constexpr (requires { FieldType::kItemForm; }) {
            return readList<FieldType::kItemForm>(json, field.about.name, member, fault);
        } else if constexpr (requires { FieldType::kKind; }) {
            return field.about.unit == wire::Unit::TagLines
                       ? readTags(json, member, fault)
                       : readMember(json, field.about.name, member, fault);
        } else {
            return isLength(field.about) || readMember(json, field.about.name, member, fault);
        }
    };
    bool isRead = true;
    wire::forEachField<T, F>([&](const auto& field) { isRead = isRead && read(field); });
    return isRead;
}

/// Reads a member of an object that keeps its value where it is not there.
template <class Value>
bool readOptional(const Json& object, std::string_view key, Value& value, FieldFault& fault) {
    return !object.contains(std::string(key)) || readMember(object, key, value, fault);
}

bool readType(const Json& object, wire::Header& header, FieldFault& fault) {
    std::array<char, 2> digits{};
    if (!readMember(object, "type", digits, fault)) {
        return false;
    }
    if (!std::ranges::all_of(digits, [](char digit) { return digit >= '0' && digit <= '9'; })) {
        return fault.fail("needs two digits, such as \"02\"") || fault.under("type");
    }
    std::ranges::copy(digits, header.id.begin() + 4);
    return true;
}

bool readCounter(const Json& object, wire::Header& header, FieldFault& fault) {
    std::uint8_t index = header.datagramIndex();
    bool isLast = header.isLast();
    if (!readOptional(object, "datagram", index, fault) || !readOptional(object, "last", isLast, fault)) {
        return false;
    }
    if (index > 0x7f) {
        return fault.fail("needs a whole number from 0 to 127") || fault.under("datagram");
    }
    header.datagramCounter = static_cast<std::uint8_t>(index | (isLast ? 0x80U : 0U));
    return true;
}

/// The header from an object; what is not there keeps its value. Reserved bytes are not part of the object:
/// where they are in use, the whole datagram is there in "bytes".
bool readHeader(const Json& object, wire::Header& header, FieldFault& fault) {
    const auto read = [&]<auto Member>(const wire::Field<Member>& field) {
        if constexpr (std::is_same_v<wire::Field<Member>, wire::Field<&wire::Header::id>>) {
            return readType(object, header, fault);
        } else if constexpr (std::is_same_v<wire::Field<Member>,
                                            wire::Field<&wire::Header::datagramCounter>>) {
            return readCounter(object, header, fault);
        } else {
            return field.about.unit == wire::Unit::Reserved ||
                   readOptional(object, field.about.name, header.*Member, fault);
        }
    };
    bool isRead = true;
    wire::forEachField<wire::Header, wire::Form::Standard>(
        [&](const auto& field) { isRead = isRead && read(field); });
    return isRead;
}

/// Bytes of the payload according to the object: from the datagram's size, else from the header.
std::optional<std::uint64_t> statedPayload(const Json& object) {
    const auto stated = [&](const char* key) -> std::optional<std::uint64_t> {
        const auto found = object.find(key);
        return found != object.end() && found->is_number_unsigned()
                   ? std::optional(found->get<std::uint64_t>())
                   : std::nullopt;
    };
    const auto size = stated("size");
    return size && *size >= wire::kHeaderSize ? std::optional(*size - wire::kHeaderSize)
                                              : stated("payloadSize");
}

/// The first field that the standard form has and the other lacks; null where there is none.
const wire::FieldRow* leftOut(std::span<const wire::FieldRow> standard,
                              std::span<const wire::FieldRow> other) {
    const auto found = std::ranges::find_if(standard, [&](const wire::FieldRow& row) {
        return std::ranges::none_of(
            other, [&](const wire::FieldRow& kept) { return kept.about.name == row.about.name; });
    });
    return found == standard.end() ? nullptr : &*found;
}

/// True for a body that lacks what the short form leaves out, itself or in its first item.
bool isShort(const Json& body, const wire::TypeInfo& message) {
    const auto standard = message.fields();
    const auto other = message.forms.back().fields;
    if (const wire::FieldRow* field = leftOut(standard, other)) {
        return !body.contains(std::string(field->about.name));
    }
    for (std::size_t i = 0; i < standard.size(); ++i) {
        const wire::FieldRow* field = leftOut(standard[i].items, other[i].items);
        const auto list = body.find(std::string(standard[i].about.name));
        if (field != nullptr && list != body.end() && list->is_array() && !list->empty()) {
            return list->front().is_object() && !list->front().contains(std::string(field->about.name));
        }
    }
    return false;
}

/// Whether a text comes without the length before it, by its size. Older senders, which leave the payload
/// size out, are taken at the word of the older specification: no length.
template <class T>
bool isBare(const T& message, std::optional<std::uint64_t> payload) {
    return payload && (*payload == 0 || *payload == wire::writtenSize<T, wire::Form::Bare>(message));
}

bool readRaw(const Json& body, wire::RawBody& raw, FieldFault& fault) {
    std::string text;
    if (!readMember(body, "raw", text, fault)) {
        return false;
    }
    auto bytes = wire::fromHexadecimal(text);
    if (!bytes) {
        return fault.fail("needs two hexadecimal digits for each byte") || fault.under("raw");
    }
    raw.bytes = std::move(*bytes);
    return true;
}

template <class T>
bool readMessage(const Json& body, std::optional<std::uint64_t> payload, T& message, FieldFault& fault) {
    wire::Form form = wire::Form::Standard;
    if constexpr (wire::kHasForm<T, wire::Form::Short>) {
        form = isShort(body, *wire::findType(T::kType)) ? wire::Form::Short : form;
    }
    wire::setForm(message, form);
    const bool isRead =
        wire::withForm<T>(form, [&]<wire::Form F>() { return readObject<T, F>(body, message, fault); });
    if constexpr (wire::kHasForm<T, wire::Form::Bare>) {
        message.*wire::kIsStandard<T> = !isBare(message, payload);
    }
    return isRead;
}

bool readBody(const Json& object, wire::Datagram& datagram, FieldFault& fault) {
    const auto body = object.find("body");
    if (body == object.end() || !body->is_object()) {
        return fault.fail("needs an object in braces") || fault.under("body");
    }
    bool isRead = false;
    const bool isKnown = !body->contains("raw") &&
                         wire::withMessage(datagram.body, datagram.header.type(), [&]<class T>(T& message) {
                             isRead = readMessage(*body, statedPayload(object), message, fault);
                         });
    if (!isKnown) {
        isRead = readRaw(*body, datagram.body.emplace<wire::RawBody>(), fault);
    }
    return isRead || fault.under("body");
}

/// Fills in what the object leaves out of the header.
void complete(const Json& object, wire::Datagram& datagram) {
    const wire::Header stated = datagram.header;
    wire::completeHeader(datagram, wire::HeaderEra::Counted);
    if (object.contains("items")) {
        datagram.header.items = stated.items;
    }
    if (object.contains("payloadSize")) {
        datagram.header.payloadSize = stated.payloadSize;
    }
}

tl::unexpected<JsonFault> failure(Kind kind, std::string text) {
    return tl::unexpected(JsonFault{kind, std::move(text)});
}

} // namespace

tl::expected<std::vector<std::byte>, JsonFault> datagramFromObject(const Json& object) {
    if (const auto bytes = object.find("bytes"); bytes != object.end()) {
        const auto* text = bytes->get_ptr<const std::string*>();
        auto whole = text != nullptr ? wire::fromHexadecimal(*text) : std::nullopt;
        if (!whole) {
            return failure(Kind::BadField, "bytes: needs two hexadecimal digits for each byte");
        }
        return std::move(*whole);
    }
    if (object.contains("skipped")) {
        return failure(Kind::NotDatagram, "is about bytes that belong to no datagram");
    }
    if (object.contains("error")) {
        return failure(Kind::NotDatagram, "is about a datagram that could not be decoded");
    }
    wire::Datagram datagram;
    FieldFault fault;
    if (!readHeader(object, datagram.header, fault) || !readBody(object, datagram, fault)) {
        return failure(Kind::BadField, fault.path + ": " + fault.text);
    }
    complete(object, datagram);
    auto encoded = wire::encode(datagram);
    if (!encoded) {
        return failure(Kind::BadField, "body: " + wire::errorText(encoded.error()));
    }
    return std::move(*encoded);
}

tl::expected<std::vector<std::byte>, JsonFault> datagramFromJson(std::string_view line) {
    const Json object = Json::parse(line, nullptr, false);
    if (!object.is_object()) {
        return failure(Kind::NotJson, "is not a JSON object");
    }
    return datagramFromObject(object);
}

} // namespace posewire::exporting
