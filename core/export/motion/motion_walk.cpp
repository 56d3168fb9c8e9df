// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_walk.h"

#include "core/export/motion/part_joiner.h"

#include <algorithm>
#include <array>
#include <optional>
#include <unordered_map>

namespace posewire::exporting {
namespace {

/// Packets that are read in one step.
constexpr std::uint64_t kPacketsAtOnce = 2048;

std::optional<std::size_t> rankOf(MotionContent content, std::uint8_t type) {
    if (content == MotionContent::Markers) {
        return type == kMarkerType ? std::optional<std::size_t>(0) : std::nullopt;
    }
    const auto found = std::ranges::find(model::kWholePoseTypes, type);
    return found == model::kWholePoseTypes.end()
               ? std::nullopt
               : std::optional(static_cast<std::size_t>(found - model::kWholePoseTypes.begin()));
}

bool markersOf(const wire::Datagram& datagram, model::LengthUnit unit, MotionSample& sample) {
    const auto* message = std::get_if<wire::PointPositions>(&datagram.body);
    if (message == nullptr) {
        return false;
    }
    sample.pose.type = datagram.header.type();
    sample.pose.sample = datagram.header.sampleCounter;
    sample.pose.timeCode = datagram.header.timeCode;
    for (const wire::Point& point : message->points) {
        const Eigen::Vector3d position = model::pointFromYUp(point.position, unit);
        if (position.allFinite()) {
            sample.markers.push_back({point.id, position});
        }
    }
    return true;
}

/// What is sent of one character, until it is in order.
class CharacterFeed {
public:
    CharacterFeed(const MotionCharacter& character, MotionContent content, SampleOrder::Take take)
        : m_character(&character), m_content(content), m_order(std::move(take)) {}

    void take(const log::Packet& packet, const wire::Header& header, std::size_t part) {
        const auto rank = rankOf(m_content, header.type());
        if (!rank) {
            return;
        }
        if (part != m_part) {
            m_order.flush();
            m_joiner.forget();
            m_part = part;
            m_newest = {};
        }
        m_newest[*rank] = packet.stamp;
        for (std::size_t better = 0; better < *rank; ++better) {
            if (m_newest[better] && packet.stamp - *m_newest[better] <= model::kSentTogether) {
                return;
            }
        }
        if (!wire::decodeInto(packet.bytes, m_datagram)) {
            return;
        }
        if (const wire::Datagram* whole = m_joiner.add(m_datagram, packet)) {
            add(*whole, packet, *rank);
        }
    }
    void finish() { m_order.flush(); }

private:
    void add(const wire::Datagram& whole, const log::Packet& packet, std::size_t rank) {
        const MotionCharacter::Part& part = m_character->parts[m_part];
        MotionSample sample;
        const bool isRead =
            m_content == MotionContent::Markers
                ? markersOf(whole, part.markerUnit, sample)
                : model::poseFromMessage(whole, m_character->body.places, part.poseUnits[rank], sample.pose);
        if (isRead) {
            sample.rank = rank;
            sample.pose.stamp = packet.stamp;
            sample.pose.packet = packet.number;
            m_order.add(std::move(sample));
        }
    }

    const MotionCharacter* m_character;
    MotionContent m_content;
    SampleOrder m_order;
    PartJoiner m_joiner;
    wire::Datagram m_datagram;
    std::size_t m_part = 0;
    std::array<std::optional<log::Stamp>, model::kWholePoseTypes.size()> m_newest{}; ///< of each type
};

} // namespace

struct MotionWalk::Parts {
    struct Place {
        std::size_t character;
        std::size_t part;
    };

    Parts(const MotionSource& from, MotionContent content, TakeSample to)
        : source(from), take(std::move(to)), reader(*from.log), next(from.firstPacket) {
        for (std::size_t i = 0; i < source.characters.size(); ++i) {
            const MotionCharacter& character = source.characters[i];
            for (std::size_t part = 0; part < character.parts.size(); ++part) {
                places.emplace(character.parts[part].key, Place{i, part});
            }
            feeds.emplace_back(character, content, [this, i](const MotionSample& sample, bool beginsRun) {
                take(i, sample, beginsRun);
            });
        }
    }

    void read(std::uint64_t number) {
        const auto packet = reader.packet(number);
        passedOver += packet ? 0 : 1;
        if (!packet || packet->flags.skipped ||
            packet->bytes.size() > model::SessionView::kMostMessageBytes) {
            return;
        }
        const auto header = wire::decodeHeader(packet->bytes);
        const auto place = header ? places.find({packet->sender, header->character}) : places.end();
        if (place != places.end()) {
            feeds[place->second.character].take(*packet, *header, place->second.part);
        }
    }

    const MotionSource& source;
    TakeSample take;
    std::unordered_map<model::CharacterKey, Place> places;
    std::vector<CharacterFeed> feeds;
    log::LogReader reader;
    std::uint64_t next;
    std::uint64_t passedOver = 0;
};

MotionWalk::MotionWalk(const MotionSource& source, MotionContent content, TakeSample take)
    : m_parts(std::make_unique<Parts>(source, content, std::move(take))) {}

MotionWalk::~MotionWalk() = default;

bool MotionWalk::advance() {
    const std::uint64_t end = m_parts->source.endPacket;
    if (m_parts->next >= end) {
        return false;
    }
    m_parts->reader.refresh(); // lets go of what was looked at
    const std::uint64_t until = std::min(end, m_parts->next + kPacketsAtOnce);
    for (; m_parts->next < until; ++m_parts->next) {
        m_parts->read(m_parts->next);
    }
    if (until == end) {
        std::ranges::for_each(m_parts->feeds, &CharacterFeed::finish);
    }
    return true;
}

double MotionWalk::share() const {
    const MotionSource& source = m_parts->source;
    return source.endPacket <= source.firstPacket
               ? 1
               : static_cast<double>(m_parts->next - source.firstPacket) /
                     static_cast<double>(source.endPacket - source.firstPacket);
}

std::uint64_t MotionWalk::passedOver() const {
    return m_parts->passedOver;
}

tl::expected<std::uint64_t, log::FileError> walkMotion(const MotionSource& source, MotionContent content,
                                                       const TakeSample& take,
                                                       const ExportProgress& progress) {
    MotionWalk walk(source, content, take);
    do {
        if (progress && !progress(walk.share())) {
            return tl::unexpected(log::FileError{"cancelled", log::FileError::Kind::Cancelled});
        }
    } while (walk.advance());
    return walk.passedOver();
}

} // namespace posewire::exporting
