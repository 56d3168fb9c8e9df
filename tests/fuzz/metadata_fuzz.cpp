// SPDX-License-Identifier: MIT
#include "core/filter/filter.h"
#include "core/model/session/metadata.h"
#include "core/wire/field_tree.h"
#include "core/wire/text.h"

#include <cstdlib>

// Whatever the text of a type 12: tags stand within it, they survive being written and read again, the
// history of a character stays bounded, and each tag can be filtered for by its own value.
namespace {

using namespace posewire;

void require(bool condition) {
    if (!condition) {
        std::abort();
    }
}

bool isWithin(std::string_view part, std::string_view text) {
    return part.empty() ||
           (part.data() >= text.data() && part.data() + part.size() <= text.data() + text.size());
}

void checkTags(std::string_view text) {
    const wire::TagList list = wire::parseTags(text);
    for (const wire::Tag& tag : list.tags) {
        require(isWithin(tag.name, text) && isWithin(tag.value, text));
        require(tag.name.find(':') == std::string_view::npos &&
                tag.name.find('\n') == std::string_view::npos);
        const auto colour = model::parseColour(tag.value);
        require(!colour || (colour->red >= 0 && colour->red <= 1));
    }
    std::string written;
    for (const wire::Tag& tag : list.tags) {
        written.append(tag.name).append(":").append(tag.value).append("\n");
    }
    const wire::TagList again = wire::parseTags(written);
    require(again.tags == list.tags && again.strayLines == 0);
}

void checkHistory(const wire::MetaData& message) {
    model::Metadata history;
    for (std::uint64_t packet = 0; packet < 3; ++packet) {
        history.add(message, packet, log::Stamp());
    }
    require(history.tags().size() <= model::Metadata::kMaxTags);
    for (const model::MetadataTag& tag : history.tags()) {
        require(!tag.values.empty() && tag.values.size() <= model::Metadata::kMaxValues);
        require(history.find(tag.name.exact()) == &tag);
    }
}

void checkFilter(const wire::Datagram& datagram, std::string_view text) {
    static const auto hasTag = *filter::Filter::compile("tag");
    static const auto isNamed = *filter::Filter::compile("tag.name matches \"^(a+)+$\" || tag.color != \"\"");
    const log::Packet packet;
    const model::PacketDigest digest;
    const filter::Candidate candidate{packet, digest, &datagram};
    require(hasTag.matches(candidate) == !wire::parseTags(text).tags.empty());
    static_cast<void>(isNamed.matches(candidate));
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    checkTags(text);
    wire::Datagram datagram;
    datagram.body = wire::MetaData{size % 2 == 0, std::string(text)};
    checkHistory(std::get<wire::MetaData>(datagram.body));
    checkFilter(datagram, text);
    wire::completeHeader(datagram, size % 3 == 0 ? wire::HeaderEra::Counted : wire::HeaderEra::Reserved);
    if (const auto bytes = wire::encode(datagram)) {
        const auto read = wire::decode(*bytes);
        require(read.has_value() == !wire::fieldTree(*bytes).fault.has_value());
    }
    return 0;
}
