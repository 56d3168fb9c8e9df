// SPDX-License-Identifier: MIT
#include "core/performer/performer.h"

#include "core/performer/messages.h"
#include "core/wire/type_table.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace posewire::performer {
namespace {

constexpr double kMetaDataPeriod = 1.0; // s
constexpr double kScalePeriod = 5.0;

/// Information about a character, sent now and then. Of all others each frame has a message.
template <class T>
constexpr bool kIsInformation =
    std::is_same_v<T, wire::ScaleInformation> || std::is_same_v<T, wire::PropInformation> ||
    std::is_same_v<T, wire::MetaData> || std::is_same_v<T, wire::NullPose>;

bool isOfE(const wire::TypeInfo& info) {
    return info.firstRevision() == 'E';
}

/// What a revision deprecates is still numbered: it is sent if asked for by number.
bool isAllowed(Revision revision, std::uint8_t type) {
    const wire::TypeInfo* info = wire::findType(type);
    return info != nullptr && (revision != Revision::E || isOfE(*info));
}

MessageDialect dialectOf(const PerformerSettings& settings) {
    MessageDialect dialect;
    switch (settings.revision) {
    case Revision::E:
        dialect.pointIds = model::PointIdCoding::By100;
        dialect.prefixesMetaData = false;
        dialect.sendsRealTags = false;
        [[fallthrough]];
    case Revision::J:
    case Revision::K:
        dialect.firstPropId = 25;
        dialect.prefixesTimeCode = !settings.asOnPaper;
        dialect.sendsMassDerivatives = false;
        dialect.sendsRealTags = dialect.sendsRealTags && !settings.asOnPaper;
        break;
    case Revision::N:
        break;
    }
    return dialect;
}

/// Whether something with a period falls into the time of a frame; always into that of frame 0.
bool isDue(std::uint64_t index, double rateHz, double period) {
    const double framesPerPeriod = std::max(1.0, rateHz * period);
    const auto periods = [&](std::uint64_t frame) {
        return std::floor(static_cast<double>(frame) / framesPerPeriod + 1e-9);
    };
    return index == 0 || periods(index) > periods(index - 1);
}

model::SegmentLayout layoutOf(const PerformerSettings& settings) {
    const bool hasFingers = settings.fingers && settings.revision == Revision::N;
    return {model::kBodySegmentCount, settings.props, hasFingers ? model::kFingerSegmentCount : 0};
}

std::uint64_t timeOfDayMs(const PerformerSettings& settings, std::uint64_t index) {
    constexpr std::uint64_t kMsPerDay = 86'400'000;
    const double elapsed = std::floor(static_cast<double>(index) * 1000.0 / settings.rateHz + 0.5);
    return (settings.startTimeOfDayMs + static_cast<std::uint64_t>(elapsed)) % kMsPerDay;
}

void fillHeader(const Character& character, Revision revision, wire::Datagram& datagram) {
    const model::SegmentLayout& layout = character.layout();
    const bool isBodyAlone = std::holds_alternative<wire::PoseUnity>(datagram.body);
    datagram.header.character = static_cast<std::uint8_t>(character.id());
    datagram.header.bodySegments = static_cast<std::uint8_t>(layout.body);
    datagram.header.props = static_cast<std::uint8_t>(isBodyAlone ? 0 : layout.props);
    datagram.header.fingerSegments = static_cast<std::uint8_t>(isBodyAlone ? 0 : layout.fingers);
    completeHeader(datagram, revision == Revision::N ? wire::HeaderEra::Counted : wire::HeaderEra::Reserved);
}

} // namespace

std::vector<std::uint8_t> typesOf(Revision revision) {
    std::vector<std::uint8_t> types;
    for (const wire::TypeInfo& info : wire::typeTable()) {
        if (revision == Revision::E ? isOfE(info) : !(isOfE(info) && info.isInOneRevision())) {
            types.push_back(info.type);
        }
    }
    return types;
}

std::optional<std::string> findProblem(const PerformerSettings& settings) {
    if (settings.characters < 1 || settings.characters > kMaxCharacters) {
        return "The number of characters must be from 1 to " + std::to_string(kMaxCharacters) + ".";
    }
    if (!(settings.rateHz >= 1.0 && settings.rateHz <= 1000.0)) {
        return "The rate must be from 1 to 1000 frames a second.";
    }
    if (settings.props < 0 || settings.props > model::kMaxPropCount) {
        return "A character can have up to " + std::to_string(model::kMaxPropCount) + " props.";
    }
    const auto names = motionNames();
    if (std::ranges::find(names, settings.motion) == names.end()) {
        return "There is no motion \"" + settings.motion + "\".";
    }
    for (const std::uint8_t type : settings.types) {
        if (!isAllowed(settings.revision, type)) {
            return "A sender of this revision has no message type " + std::to_string(type) + ".";
        }
    }
    return std::nullopt;
}

Performer::Performer(PerformerSettings settings)
    : m_settings(std::move(settings)),
      m_types(m_settings.types.empty() ? typesOf(m_settings.revision) : m_settings.types) {
    m_characters.reserve(static_cast<std::size_t>(m_settings.characters));
    for (int id = 0; id < m_settings.characters; ++id) {
        m_characters.emplace_back(CharacterSettings{id, m_settings.characters, m_settings.seed,
                                                    m_settings.motion, layoutOf(m_settings)},
                                  m_settings.rateHz);
    }
}

bool Performer::sends(std::uint8_t type) const {
    return std::ranges::find(m_types, type) != m_types.end();
}

void Performer::add(const Character& character, wire::Body body, std::vector<wire::Datagram>& into) const {
    wire::Datagram& datagram = into.emplace_back();
    datagram.body = std::move(body);
    fillHeader(character, m_settings.revision, datagram);
}

void Performer::addInformation(const Character& character, std::vector<wire::Datagram>& into,
                               bool withScale) const {
    const MessageDialect dialect = dialectOf(m_settings);
    if (withScale && sends(10)) {
        add(character, scaleInformation(character), into);
    }
    if (withScale && sends(11)) {
        add(character, propInformation(character, dialect), into);
    }
    if (sends(12)) {
        add(character, metaData(character, m_settings.characters, dialect), into);
    }
    if (!withScale || !sends(13)) {
        return;
    }
    std::vector<wire::NullPose> parts = nullPoseParts(character);
    for (std::size_t part = 0; part < parts.size(); ++part) {
        add(character, std::move(parts[part]), into);
        const bool isLast = part + 1 == parts.size();
        into.back().header.datagramCounter = static_cast<std::uint8_t>(part | (isLast ? 0x80U : 0U));
    }
}

void Performer::addFrameTypes(Character& character, std::uint64_t index,
                              std::vector<wire::Datagram>& into) const {
    const MessageDialect dialect = dialectOf(m_settings);
    const Subject subject{character, character.at(index), dialect,
                          static_cast<double>(index) / m_settings.rateHz, timeOfDayMs(m_settings, index)};
    wire::Messages::forEach([&]<class T>() {
        if constexpr (!kIsInformation<T>) {
            if (sends(T::kType)) {
                T message;
                perform(subject, message);
                if constexpr (requires { turnTo(model::UpAxis::Y, message); }) {
                    if (m_settings.isYUp) {
                        turnTo(model::UpAxis::Y, message);
                    }
                }
                add(character, std::move(message), into);
                into.back().header.sampleCounter = m_settings.firstSample + static_cast<std::uint32_t>(index);
                into.back().header.timeCode = static_cast<std::uint32_t>(subject.timeOfDayMs);
            }
        }
    });
}

void Performer::frameInto(std::uint64_t index, std::vector<wire::Datagram>& into) {
    into.clear();
    const bool withScale = isDue(index, m_settings.rateHz, kScalePeriod);
    const bool withMetaData = withScale || isDue(index, m_settings.rateHz, kMetaDataPeriod);
    for (Character& character : m_characters) {
        if (withMetaData) {
            addInformation(character, into, withScale);
        }
        addFrameTypes(character, index, into);
    }
}

std::vector<wire::Datagram> Performer::frame(std::uint64_t index) {
    std::vector<wire::Datagram> datagrams;
    frameInto(index, datagrams);
    return datagrams;
}

} // namespace posewire::performer
