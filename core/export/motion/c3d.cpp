// SPDX-License-Identifier: MIT
#include "core/export/motion/c3d.h"

#include "core/export/motion/c3d_parameters.h"
#include "core/export/motion/skeleton.h"
#include "core/model/body/points.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>

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
            takeSegments(*frame.pose);
        }
        for (const feed::Marker& marker : frame.markers) {
            if (const auto place = m_placeOfMarker.find(marker.id); place != m_placeOfMarker.end()) {
                m_points[place->second] = marker.position;
            }
        }
        write(out);
    }

private:
    void takeSegments(const model::CharacterPose& pose) {
        for (std::size_t i = 0; i < m_labels.size(); ++i) {
            const auto place = model::placeOf(m_survey.layout, static_cast<int>(i));
            const int position = place ? positionIn(pose.layout, *place) : -1;
            const auto index = static_cast<std::size_t>(std::max(position, 0));
            if (position >= 0 && index < pose.segments.size() && pose.isPresent(index)) {
                m_points[i] = pose.segments[index].position;
            }
        }
    }

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
