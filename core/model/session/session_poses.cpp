// SPDX-License-Identifier: MIT
#include "core/model/body/null_pose_measures.h"
#include "core/model/body/pose_remark.h"
#include "core/model/session/decoded.h"

#include <algorithm>
#include <utility>

namespace posewire::model {
namespace {

/// Those that are put together, the most telling first.
constexpr std::array<std::uint8_t, 3> kPartTypes{wire::LinearKinematics::kType,
                                                 wire::AngularKinematics::kType, wire::PointPositions::kType};
/// Datagrams that are looked at for one sample; as many samples back, one is looked for that all have.
constexpr std::size_t kSampleSearch = 64;
constexpr std::size_t kCommonSearch = 8;

constexpr std::uint64_t kMeasured = std::uint64_t{1} << 63;

void move(const Eigen::Vector3d& way, CharacterPose& pose) {
    for (SegmentPose& segment : pose.segments) {
        segment.position += way;
    }
    pose.moved += way;
}

/// As high as the performer's pelvis is above the soles: a figure without a floor has it at z = 0.
void lift(const BodyOrigins& body, CharacterPose& pose) {
    const double height = body.places[segment::kPelvis].z() - body.floor;
    move({0, 0, height}, pose);
    pose.isLifted = true;
}

/// Those whose place is not known stand side by side.
void standInRow(std::uint8_t character, CharacterPose& pose) {
    constexpr double kApart = 1.0; // metres
    move({0, kApart * character, 0}, pose);
}

} // namespace

/// The newest of the types that hold whole poses.
const Message* SessionView::wholePose(const CharacterKey& key) const {
    const Message* best = nullptr;
    for (const std::uint8_t type : kWholePoseTypes) {
        const Message* candidate = message(key, type);
        if (candidate != nullptr && (best == nullptr || candidate->stamp > best->stamp + kSentTogether)) {
            best = candidate;
        }
    }
    return best;
}

/// The message of a sample that is not older than `kSampleSearch` datagrams; null where it is not whole.
const Message* SessionView::messageOfSample(const CharacterKey& key, std::size_t part,
                                            std::uint32_t sample) const {
    const log::StreamKey streamKey{key.sender, key.character, kPartTypes[part]};
    const log::StreamEntries* stream = m_ingest.index().find(streamKey);
    const std::size_t count = stream != nullptr ? visibleCount(*stream) : 0;
    for (std::size_t i = count; i-- > (count > kSampleSearch ? count - kSampleSearch : 0);) {
        if ((*stream)[i].sample != sample) {
            continue;
        }
        Decoded::OfStream& read = decoded().characters[key].parts[part];
        if (read.packet != (*stream)[i].packet) {
            read.isValid = readMessage(*stream, i + 1, read.message);
            read.packet = (*stream)[i].packet;
        }
        const bool isIt = read.isValid && read.message.datagram.header.sampleCounter == sample;
        return isIt ? &read.message : nullptr;
    }
    return nullptr;
}

/// What there is of types 21, 22 and 03 for the newest sample that all of them have; where none has all, the
/// newest of the most telling one. In the order of kPartTypes, null for none.
SessionView::PoseMessages SessionView::posePartsOf(const CharacterKey& key) const {
    PoseMessages newest{};
    log::Stamp latest{};
    for (std::size_t i = 0; i < newest.size(); ++i) {
        newest[i] = message(key, kPartTypes[i]);
        latest = newest[i] != nullptr ? std::max(latest, newest[i]->stamp) : latest;
    }
    const Message* slowest = nullptr;
    for (const Message*& one : newest) {
        one = one != nullptr && one->stamp + kSentTogether >= latest ? one : nullptr;
        slowest = one != nullptr && (slowest == nullptr || one->stamp < slowest->stamp) ? one : slowest;
    }
    if (std::ranges::count(newest, nullptr) >= 2) {
        return newest;
    }
    // Of a stream of one sender alone are samples looked up.
    const CharacterKey own{slowest->sender, key.character};
    std::uint32_t sample = slowest->datagram.header.sampleCounter;
    for (std::size_t step = 0; step < kCommonSearch; ++step, --sample) {
        PoseMessages common{};
        bool isCommon = true;
        for (std::size_t i = 0; i < newest.size(); ++i) {
            if (newest[i] != nullptr) {
                const bool isIt = newest[i]->datagram.header.sampleCounter == sample;
                common[i] = isIt ? newest[i] : messageOfSample(own, i, sample);
                isCommon = isCommon && common[i] != nullptr;
            }
        }
        if (isCommon) {
            return common;
        }
    }
    const auto first = std::ranges::find_if(newest, [](const Message* one) { return one != nullptr; });
    std::fill(std::next(first), newest.end(), nullptr);
    return newest;
}

const CharacterPose* SessionView::pose(const CharacterKey& key) const {
    PoseMessages messages{wholePose(key)};
    const PoseMessages parts = posePartsOf(key);
    const auto isNewer = [&](const Message* one) {
        return one != nullptr && (messages[0] == nullptr || one->stamp > messages[0]->stamp + kSentTogether);
    };
    if (std::ranges::any_of(parts, isNewer)) {
        messages = parts;
    }
    const BodyOrigins& body = bodyOrigins(key);
    Decoded::OfCharacter& read = decoded().characters[key];
    Decoded::PoseOrigin origin;
    origin.body = read.bodyOrigin;
    origin.isLifted = isLifted(key);
    bool isAny = false;
    for (std::size_t i = 0; i < messages.size(); ++i) {
        if (const Message* one = messages[i]) {
            origin.packets[i] = one->packet;
            origin.units[i] = unitOf(*one);
            isAny = true;
        }
    }
    if (!isAny) {
        return nullptr;
    }
    if (read.poseOrigin != origin) {
        read.isValid = readPose(messages, body, read.pose);
        if (read.isValid && read.pose.isPlaceAssumed) {
            standInRow(key.character, read.pose);
        }
        if (read.isValid && origin.isLifted && isBelowFloor(read.pose)) {
            lift(body, read.pose);
        }
        read.poseOrigin = origin;
    }
    return read.isValid ? &read.pose : nullptr;
}

LengthUnit SessionView::unitOf(const Message& message) const {
    const Sender* sender = find(message.sender);
    return sender != nullptr ? sender->positionUnit(message.datagram.header.type()) : LengthUnit::Metre;
}

bool SessionView::readPose(const PoseMessages& messages, const BodyOrigins& body, CharacterPose& pose) const {
    std::array<PosePart, 3> parts{};
    std::size_t count = 0;
    const Message* newest = nullptr;
    for (const Message* one : messages) {
        if (one != nullptr) {
            parts[count++] = {&one->datagram, unitOf(*one)};
            newest = newest == nullptr || one->packet > newest->packet ? one : newest;
        }
    }
    if (newest == nullptr || !poseFromParts(std::span(parts).first(count), body, pose)) {
        return false;
    }
    pose.packet = newest->packet;
    pose.stamp = newest->stamp;
    return true;
}

PoseRemark SessionView::poseRemark(const CharacterKey& key) const {
    const CharacterPose* shown = pose(key);
    return shown != nullptr ? remarkOn(*shown, bodyOrigins(key)) : PoseRemark{};
}

/// At a paused cursor of what is at hand decoded: messages in one datagram.
std::optional<PoseRemark> SessionView::poseRemarkNow(const CharacterKey& key) const {
    if (!isPaused()) {
        const CharacterPose* shown = pose(key);
        return shown != nullptr ? std::optional(remarkOn(*shown, bodyOrigins(key))) : std::nullopt;
    }
    const auto newest = [&](const std::array<std::uint8_t, 3>& types) {
        PoseMessages messages{};
        log::Stamp latest{};
        for (std::size_t i = 0; i < types.size(); ++i) {
            messages[i] = m_ingest.newest({key.sender, key.character, types[i]});
            latest = messages[i] != nullptr ? std::max(latest, messages[i]->stamp) : latest;
        }
        for (const Message*& one : messages) {
            one = one != nullptr && one->stamp + kSentTogether >= latest ? one : nullptr;
        }
        return std::pair(messages, latest);
    };
    const auto [whole, wholeStamp] = newest(kWholePoseTypes);
    const auto [parts, partsStamp] = newest(kPartTypes);
    const auto first = std::ranges::find_if(whole, [](const Message* one) { return one != nullptr; });
    const bool isWhole = first != whole.end() && wholeStamp + kSentTogether >= partsStamp;
    CharacterPose pose;
    const BodyOrigins& body = bodyOrigins(key);
    const PoseMessages messages = isWhole ? PoseMessages{*first} : parts;
    if (std::ranges::all_of(messages, [](const Message* one) { return one == nullptr; })) {
        const Character* character = find(key);
        const auto isPose = [](const Stream* one) { return hasPoses(one->key.type); };
        const bool isInParts = character != nullptr && std::ranges::any_of(character->streams, isPose);
        return isInParts ? std::optional(PoseRemark{}) : std::nullopt;
    }
    return readPose(messages, body, pose) ? std::optional(remarkOn(pose, body)) : std::nullopt;
}

const BodyOrigins& SessionView::bodyOrigins(const CharacterKey& key) const {
    const NullPose* pose = nullPose(key);
    const Character* character = find(key);
    const BodyMeasure* measure = pose == nullptr && character != nullptr ? &character->measuredBody : nullptr;
    const std::uint64_t origin = pose != nullptr      ? pose->packet
                                 : measure != nullptr ? kMeasured | measure->version()
                                                      : UINT64_MAX;
    Decoded::OfCharacter& read = decoded().characters[key];
    if (read.origins && read.bodyOrigin == origin) {
        return *read.origins;
    }
    read.bodyOrigin = origin;
    const auto measured = measure != nullptr ? measure->body() : std::nullopt;
    read.origins = pose != nullptr ? bodyOf(*pose) : measured.value_or(BodyOrigins{referenceOrigins()});
    return *read.origins;
}

} // namespace posewire::model
