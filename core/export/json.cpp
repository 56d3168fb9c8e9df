// SPDX-License-Identifier: MIT
#include "core/export/json.h"

#include "core/export/json_fields.h"
#include "core/export/json_value.h"
#include "core/model/body/item_names.h"
#include "core/wire/codec.h"
#include "core/wire/form.h"
#include "core/wire/text.h"
#include "core/wire/walk.h"
#include "core/words/say.h"

#include <cmath>

namespace posewire::exporting {
namespace {

Json jsonOf(float value) {
    return std::isfinite(value) ? Json(value) : Json(numberText(value));
}

template <std::size_t N>
Json jsonOf(const std::array<float, N>& values) {
    Json list = Json::array();
    for (const float value : values) {
        list.push_back(jsonOf(value));
    }
    return list;
}

/// Text that is not UTF-8 cannot be in JSON: each byte out of place becomes a question mark.
Json jsonOf(std::string text) {
    for (std::size_t bad = 0; (bad = wire::firstInvalidUtf8(text)) != text.size();) {
        text[bad] = '?';
    }
    return text;
}

template <std::size_t N>
Json jsonOf(const std::array<char, N>& characters) {
    return jsonOf(std::string(characters.data(), N));
}

Json jsonOf(std::integral auto value) {
    return value;
}

Json tagsOf(const std::string& text) {
    Json tags = Json::array();
    for (const wire::Tag& tag : wire::parseTags(text).tags) {
        tags.push_back(Json::array({std::string(tag.name), std::string(tag.value)}));
    }
    return tags;
}

template <class T, wire::Form F>
Json fieldsOf(const T& value) {
    Json object = Json::object();
    wire::forEachField<T, F>([&]<class FieldType>(const FieldType& field) {
        const auto& member = value.*FieldType::kMember;
        const std::string key(field.about.name);
        if constexpr (requires { FieldType::kItemForm; }) {
            Json& list = object[key] = Json::array();
            for (const auto& item : member) {
                list.push_back(fieldsOf<typename FieldType::Item, FieldType::kItemForm>(item));
            }
        } else if constexpr (requires { FieldType::kKind; }) {
            const bool isTags = field.about.unit == wire::Unit::TagLines;
            object[isTags ? kTagsKey : key] = isTags ? tagsOf(member) : jsonOf(member);
        } else if (!isLength(field.about)) {
            object[key] = jsonOf(member);
        }
    });
    return object;
}

/// Adds the header's fields as far as they could be read.
class HeaderToJson : public wire::SilentVisitor {
public:
    explicit HeaderToJson(Json& to) : m_object(to) {}

    template <class Value>
    void field(const wire::About& about, std::size_t, std::size_t, const Value& value) {
        if (about.parts.empty() && about.unit != wire::Unit::Reserved) {
            m_object[std::string(about.name)] = jsonOf(value);
        }
        for (const wire::FieldPart& part : about.parts) {
            if (!part.key.empty()) {
                m_object[std::string(part.key)] = partOf(part, value);
            }
        }
    }

private:
    template <std::size_t N>
    static Json partOf(const wire::FieldPart& part, const std::array<char, N>& characters) {
        return jsonOf(std::string(characters.data() + part.offset, part.size));
    }
    static Json partOf(const wire::FieldPart& part, std::unsigned_integral auto value) {
        const unsigned bits = value & part.bits;
        return part.isFlag() ? Json(bits != 0) : jsonOf(bits);
    }

    Json& m_object;
};

void addHeader(Json& object, wire::Bytes bytes) {
    const auto read = wire::decodeHeader(bytes);
    const bool isCut = !read && read.error().code == wire::ErrorCode::HeaderTruncated;
    if ((!read && !isCut) || !wire::startsDatagram(bytes)) {
        return;
    }
    wire::Header header;
    wire::Cursor cursor{bytes.first(std::min(bytes.size(), wire::kHeaderSize)), 0, 0, {}};
    HeaderToJson visitor(object);
    wire::readLayout<wire::Header, wire::Form::Standard>(cursor, header, visitor);
}

Json bodyOf(const wire::Body& body) {
    Json object = Json::object();
    if (const auto* raw = std::get_if<wire::RawBody>(&body)) {
        object["raw"] = wire::hexadecimal(raw->bytes);
    }
    wire::visitMessage(body,
                       [&]<wire::Form F, class T>(const T& message) { object = fieldsOf<T, F>(message); });
    return object;
}

Json placed(const DatagramPlace& place, std::uint64_t size) {
    return {{"index", place.index}, {"offset", place.offset}, {"size", size}};
}

Json errorOf(const wire::WireError& error) {
    return {{"code", std::string(wire::errorName(error.code))},
            {"offset", error.offset},
            {"need", error.need},
            {"have", error.have},
            {"text", wire::errorText(error)}};
}

Json noticesOf(const wire::Datagram& datagram) {
    Json notices = Json::array();
    for (const wire::Notice& notice : datagram.notices) {
        notices.push_back(wire::noticeText(notice));
    }
    return notices;
}

bool givesBack(const Json& object, wire::Bytes bytes) {
    const auto again = datagramFromObject(object);
    return again && std::equal(again->begin(), again->end(), bytes.begin(), bytes.end());
}

void addNames(const wire::Datagram& datagram, Json& body) {
    Json& items = body.front();
    for (std::size_t i = 0; items.is_array() && i < items.size(); ++i) {
        if (const std::string_view name = model::itemName(datagram, i); !name.empty()) {
            items[i]["name"] = name;
        }
    }
}

} // namespace

std::string datagramJson(const DatagramPlace& place, wire::Bytes bytes, bool hasNames) {
    Json object = placed(place, bytes.size());
    object["stampNs"] = place.time ? Json(log::nanosecondsOf(*place.time)) : Json();
    object["source"] = place.sender ? jsonOf(*place.sender) : Json();
    addHeader(object, bytes);
    const auto datagram = wire::decode(bytes);
    if (!datagram) {
        object["error"] = errorOf(datagram.error());
        object["notices"] = Json::array();
        return object.dump();
    }
    object["body"] = bodyOf(datagram->body);
    object["notices"] = noticesOf(*datagram);
    if (place.shared != 0) {
        object["notices"].push_back(say(words::sharedFact(place.shared), words::Form::Sentence));
    }
    if (!givesBack(object, bytes)) {
        object["bytes"] = wire::hexadecimal(bytes);
    }
    if (hasNames) {
        addNames(*datagram, object["body"]);
    }
    return object.dump();
}

std::string skippedJson(const DatagramPlace& place, std::uint64_t size) {
    Json object = placed(place, size);
    object["skipped"] = true;
    return object.dump();
}

} // namespace posewire::exporting
