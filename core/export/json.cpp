// SPDX-License-Identifier: MIT
#include "core/export/json.h"

#include "core/export/hexadecimal.h"
#include "core/export/json_reading.h"
#include "core/wire/codec.h"
#include "core/wire/forms_of.h"
#include "core/wire/walk.h"

namespace posewire::exporting {
namespace {

/// Adds the header's fields as far as they could be read.
struct HeaderToJson {
    static constexpr bool kListens = true;
    Json& object;

    template <class Value>
    void field(const wire::About& about, std::size_t, std::size_t, const Value& value) {
        if constexpr (std::is_same_v<Value, decltype(wire::Header::id)>) {
            object["type"] = std::string(value.data() + 4, 2);
        } else if (about.name == "datagramCounter") {
            object["datagram"] = static_cast<std::uint64_t>(value & 0x7fU);
            object["last"] = (value & 0x80U) != 0;
        } else if (about.name != "reserved") {
            object[std::string(about.name)] = jsonOf(value);
        }
    }
};

void addHeader(Json& object, wire::Bytes bytes) {
    if (!wire::startsDatagram(bytes)) {
        return;
    }
    wire::Header header;
    wire::Cursor cursor{bytes.first(std::min(bytes.size(), wire::kHeaderSize)), 0, 0, {}};
    HeaderToJson visitor{object};
    wire::readLayout<wire::Header, wire::Form::Standard>(cursor, header, visitor);
}

struct BodyToJson {
    Json operator()(const wire::RawBody& raw) const { return Json{{"raw", hexadecimal(raw.bytes)}}; }
    template <class T>
    Json operator()(const T& message) const {
        return wire::withForm<T>(wire::formOf(message),
                                 [&]<wire::Form F>() { return objectOf<T, F>(message); });
    }
};

Json placed(const DatagramPlace& place, std::uint64_t size) {
    Json object = Json::object();
    object["index"] = place.index;
    object["offset"] = place.offset;
    object["size"] = size;
    return object;
}

Json errorOf(const wire::WireError& error) {
    Json object = Json::object();
    object["code"] = std::string(wire::errorName(error.code));
    object["offset"] = error.offset;
    object["need"] = error.need;
    object["have"] = error.have;
    object["text"] = wire::errorText(error);
    return object;
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

} // namespace

std::string datagramJson(const DatagramPlace& place, wire::Bytes bytes) {
    Json object = placed(place, bytes.size());
    object["stampNs"] = place.stampNs ? Json(*place.stampNs) : Json();
    object["source"] = place.sender ? jsonOf(*place.sender) : Json();
    addHeader(object, bytes);
    const auto datagram = wire::decode(bytes);
    if (!datagram) {
        object["error"] = errorOf(datagram.error());
        object["notices"] = Json::array();
        return object.dump();
    }
    object["body"] = std::visit(BodyToJson{}, datagram->body);
    object["notices"] = noticesOf(*datagram);
    if (!givesBack(object, bytes)) {
        object["bytes"] = hexadecimal(bytes);
    }
    return object.dump();
}

std::string skippedJson(const DatagramPlace& place, std::uint64_t size) {
    Json object = placed(place, size);
    object["skipped"] = true;
    return object.dump();
}

} // namespace posewire::exporting
