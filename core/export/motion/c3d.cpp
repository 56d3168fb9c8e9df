// SPDX-License-Identifier: MIT
#include "core/export/motion/motion_writer.h"

#include "core/export/motion/skeleton.h"
#include "core/model/body/points.h"

#include <algorithm>
#include <array>
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

/// Clipped to a byte, as the format has numbers of names, texts and dimensions.
char byteOf(std::size_t value) {
    return static_cast<char>(static_cast<unsigned char>(value));
}

std::string contentOf(Type type, std::initializer_list<std::size_t> dimensions) {
    std::string content{static_cast<char>(type), byteOf(dimensions.size())};
    std::ranges::transform(dimensions, std::back_inserter(content), byteOf);
    return content;
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
            content += lowBytes(value);
        }
        addItem(name, m_group, content);
    }

    void add(std::string_view name, float value) {
        addItem(name, m_group, contentOf(Type::Real, {}) + lowBytes(value));
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
        constexpr char kIntel = 84;
        std::string bytes = std::string{'\x01', '\x50', byteOf(blocks()), kIntel} + m_items;
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
        // Behind the name: how far it is to the next item; behind the content: an empty description.
        const auto way = static_cast<std::int16_t>(sizeof(std::int16_t) + content.size() + 1);
        m_items += byteOf(name.size());
        m_items += static_cast<char>(group);
        m_items.append(name).append(lowBytes(way)).append(content) += '\0';
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
            const auto [x, y, z] = model::toFloats(at);
            m_bytes += lowBytes(x, y, z, point ? 0.0F : kUnmeasured);
        }
        out.write(m_bytes);
    }

    [[nodiscard]] std::string header(std::size_t parameterBlocks) const {
        constexpr std::int16_t kNone = 0; // analogue measurements, interpolated frames, of those in a frame
        constexpr std::int16_t kFirstFrame = 1;
        std::string bytes =
            std::string{'\x02', '\x50'} + // the block with the parameters
            lowBytes(word(m_labels.size()), kNone, kFirstFrame, word(m_survey.frames), kNone, kScale,
                     word(1 + parameterBlocks + 1), kNone, static_cast<float>(m_survey.writtenRateHz()));
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
