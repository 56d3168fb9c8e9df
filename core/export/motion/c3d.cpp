// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_writer.h"

#include "core/export/motion/skeleton.h"
#include "core/model/body/points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <vector>

namespace posewire::exporting {
namespace {

constexpr double kMillimetres = 1000;
constexpr std::uint64_t kMostInWord = 65'535;
constexpr std::size_t kMostInList = 255; ///< of texts
/// Below 0: the points are floats. Its size means nothing then.
constexpr float kScale = -0.1F;
constexpr float kUnmeasured = -1;

std::int16_t word(std::uint64_t value) {
    return static_cast<std::int16_t>(static_cast<std::uint16_t>(std::min(value, kMostInWord)));
}

/// "pSacrum", with its segment where several have a point of that name; "P513" for points nobody knows.
std::vector<std::string> labelsOf(const std::vector<std::uint32_t>& markerIds) {
    const model::PointIdCoding coding = model::detectPointIdCoding(markerIds);
    std::vector<std::string> labels;
    std::unordered_set<std::string> taken;
    for (const std::uint32_t id : markerIds) {
        const auto reference = model::knownPoint(coding, id);
        const model::AnatomicalPoint* point =
            reference ? model::findPoint(reference->segmentId - 1, reference->localId) : nullptr;
        std::string label = point != nullptr ? std::string(point->name) : "P" + std::to_string(id);
        if (!taken.insert(label).second && point != nullptr) {
            const auto segment = static_cast<std::size_t>(point->segment);
            label = std::string(model::bodySegments()[segment].name) + '_' + label;
            taken.insert(label);
        }
        labels.push_back(std::move(label));
    }
    return labels;
}

enum class Type : std::int8_t { Text = -1, Integer = 2, Real = 4 };

void appendByte(std::size_t value, std::string& bytes) {
    bytes += static_cast<char>(static_cast<unsigned char>(value));
}

template <class Number>
void appendLow(Number bits, std::string& bytes) {
    for (std::size_t i = 0; i < sizeof(bits); ++i) {
        appendByte(static_cast<std::size_t>(bits >> (8 * i)) & 0xff, bytes);
    }
}

std::string contentOf(Type type, std::initializer_list<std::size_t> dimensions) {
    std::string content;
    appendByte(static_cast<std::size_t>(type), content);
    appendByte(dimensions.size(), content);
    for (const std::size_t size : dimensions) {
        appendByte(size, content);
    }
    return content;
}

/// Intel order.
void appendC3d(std::int16_t value, std::string& bytes) {
    appendLow(static_cast<std::uint16_t>(value), bytes);
}

void appendC3d(float value, std::string& bytes) {
    appendLow(std::bit_cast<std::uint32_t>(value), bytes);
}

/// The parameter section of a C3D file, byte by byte in Intel order. Groups are numbered as they are begun;
/// parameters belong to the newest one.
class C3dParameters {
public:
    static constexpr std::size_t kBlock = 512;
    static constexpr std::size_t kMostText = 127; ///< bytes

    void beginGroup(std::string_view name) {
        ++m_group;
        addItem(name, static_cast<std::int8_t>(-m_group), {});
    }

    void add(std::string_view name, std::span<const std::int16_t> values) {
        std::string content =
            values.size() == 1 ? contentOf(Type::Integer, {}) : contentOf(Type::Integer, {values.size()});
        for (const std::int16_t value : values) {
            appendC3d(value, content);
        }
        addItem(name, m_group, content);
    }

    void add(std::string_view name, float value) {
        std::string content = contentOf(Type::Real, {});
        appendC3d(value, content);
        addItem(name, m_group, content);
    }

    /// One text, or several of the length of the longest; at most 255. Longer texts are clipped.
    void add(std::string_view name, std::span<const std::string> texts) {
        std::size_t length = 0;
        for (const std::string& text : texts) {
            length = std::max(length, std::min(text.size(), kMostText));
        }
        std::string content = contentOf(Type::Text, {length, texts.size()});
        for (const std::string& text : texts) {
            const std::string_view kept = std::string_view(text).substr(0, length);
            content.append(kept).append(length - kept.size(), ' ');
        }
        addItem(name, m_group, content);
    }

    void add(std::string_view name, std::string_view text) {
        const std::string_view kept = text.substr(0, kMostText);
        std::string content = contentOf(Type::Text, {kept.size()});
        addItem(name, m_group, content.append(kept));
    }

    /// Whole blocks.
    [[nodiscard]] std::string section() const {
        constexpr std::size_t intel = 84;
        std::string bytes;
        appendByte(1, bytes);
        appendByte(0x50, bytes);
        appendByte(blocks(), bytes);
        appendByte(intel, bytes);
        bytes += m_items;
        bytes.resize(blocks() * kBlock, '\0'); // an item without a name ends them
        return bytes;
    }

    [[nodiscard]] std::size_t blocks() const {
        constexpr std::size_t head = 4;
        constexpr std::size_t end = 4;
        return (head + m_items.size() + end + kBlock - 1) / kBlock;
    }

private:
    void addItem(std::string_view name, std::int8_t group, std::string_view content) {
        appendByte(name.size(), m_items);
        appendByte(static_cast<std::size_t>(group), m_items);
        m_items += name;
        // To the next item, from here on; then an empty description.
        appendC3d(static_cast<std::int16_t>(sizeof(std::int16_t) + content.size() + 1), m_items);
        m_items += content;
        appendByte(0, m_items);
    }

    std::string m_items;
    std::int8_t m_group = 0;
};

class C3dWriter final : public MotionWriter {
public:
    explicit C3dWriter(const MotionTask& task)
        : m_character(task.characterAt(task.characters.front())),
          m_survey(task.surveyAt(task.characters.front())),
          m_application(task.application),
          m_labels(labelsOf(m_survey.markerIds)) {
        for (std::size_t i = 0; i < m_survey.markerIds.size(); ++i) {
            m_placeOfMarker.emplace(m_survey.markerIds[i], i);
        }
        if (m_labels.empty()) {
            for (int position = 0; position < m_survey.layout.count(); ++position) {
                m_labels.emplace_back(model::segmentName(m_survey.layout, position));
            }
        }
    }

    void begin(MotionOutput& out) override {
        std::size_t blocks = parameters(0).blocks();
        out.write(header(blocks));
        out.write(parameters(1 + blocks + 1).section());
    }

    void add(const MotionFrame& frame, MotionOutput& out) override {
        m_points.assign(m_labels.size(), std::nullopt);
        if (!frame.isGap() && m_survey.markerIds.empty()) {
            for (std::size_t i = 0; i < m_labels.size(); ++i) {
                const auto* segment = poseAt(*frame.pose, m_survey.layout, static_cast<int>(i));
                m_points[i] = segment != nullptr ? std::optional(segment->position) : std::nullopt;
            }
        }
        for (const feed::Marker& marker : frame.markers) {
            if (const auto place = m_placeOfMarker.find(marker.id); place != m_placeOfMarker.end()) {
                m_points[place->second] = marker.position;
            }
        }
        write(out);
    }

private:
    void write(MotionOutput& out) {
        m_bytes.clear();
        for (const auto& point : m_points) {
            const Eigen::Vector3d at =
                point ? Eigen::Vector3d(kMillimetres * *point) : Eigen::Vector3d::Zero();
            for (const double value : {at.x(), at.y(), at.z()}) {
                appendC3d(static_cast<float>(value), m_bytes);
            }
            appendC3d(point ? 0.0F : kUnmeasured, m_bytes);
        }
        out.write(m_bytes);
    }

    [[nodiscard]] std::string header(std::size_t parameterBlocks) const {
        std::string bytes{'\x02', '\x50'}; // the block with the parameters
        appendC3d(word(m_labels.size()), bytes);
        appendC3d(std::int16_t{0}, bytes); // analogue measurements
        appendC3d(std::int16_t{1}, bytes); // the first frame
        appendC3d(word(m_survey.frames), bytes);
        appendC3d(std::int16_t{0}, bytes); // frames that were interpolated
        appendC3d(kScale, bytes);
        appendC3d(word(1 + parameterBlocks + 1), bytes);
        appendC3d(std::int16_t{0}, bytes);
        appendC3d(static_cast<float>(m_survey.writtenRateHz()), bytes);
        bytes.resize(C3dParameters::kBlock, '\0');
        return bytes;
    }

    [[nodiscard]] C3dParameters parameters(std::size_t dataBlock) const {
        C3dParameters all;
        all.beginGroup("POINT");
        all.add("USED", std::array{word(m_labels.size())});
        all.add("SCALE", kScale);
        all.add("RATE", static_cast<float>(m_survey.writtenRateHz()));
        all.add("DATA_START", std::array{word(dataBlock)});
        all.add("FRAMES", std::array{word(m_survey.frames)});
        if (m_survey.frames > kMostInWord) {
            all.add("LONG_FRAMES", static_cast<float>(m_survey.frames));
        }
        all.add("UNITS", std::string_view("mm"));
        all.add("X_SCREEN", std::string_view("+X"));
        all.add("Y_SCREEN", std::string_view("+Z"));
        for (std::size_t first = 0; first < m_labels.size(); first += kMostInList) {
            const std::size_t list = first / kMostInList + 1;
            all.add(list == 1 ? "LABELS" : "LABELS" + std::to_string(list),
                    std::span(m_labels).subspan(first, std::min(kMostInList, m_labels.size() - first)));
        }
        all.beginGroup("TRIAL"); // 32 bits each, the low half first
        const auto high = static_cast<std::int16_t>(static_cast<std::uint16_t>(m_survey.frames >> 16));
        const auto low = static_cast<std::int16_t>(static_cast<std::uint16_t>(m_survey.frames & kMostInWord));
        all.add("ACTUAL_START_FIELD", std::array<std::int16_t, 2>{1, 0});
        all.add("ACTUAL_END_FIELD", std::array{low, high});
        all.beginGroup("ANALOG");
        all.add("USED", std::array{std::int16_t{0}});
        all.add("GEN_SCALE", 1.0F);
        all.add("RATE", 0.0F);
        all.beginGroup("SUBJECTS");
        all.add("USED", std::array{std::int16_t{1}});
        all.add("NAMES", std::array{m_character.name.shown()});
        all.beginGroup("MANUFACTURER");
        all.add("SOFTWARE", std::string_view(m_application));
        return all;
    }

    const feed::PoseCharacter& m_character;
    const CharacterSurvey& m_survey;
    const std::string& m_application;
    std::vector<std::string> m_labels;
    std::unordered_map<std::uint32_t, std::size_t> m_placeOfMarker;
    std::vector<std::optional<Eigen::Vector3d>> m_points; ///< of a frame
    std::string m_bytes;
};

} // namespace

std::unique_ptr<MotionWriter> makeC3d(const MotionTask& task) {
    return std::make_unique<C3dWriter>(task);
}

} // namespace posewire::exporting
