// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/mvnx/subject.h"

#include "core/model/body/points.h"

#include <algorithm>

namespace posewire::mvnx {
namespace {

constexpr std::size_t kLongestName = 256;

tl::expected<void, log::FileError> fits(const XmlReader& xml, std::size_t size, std::size_t most) {
    return size <= most ? tl::expected<void, log::FileError>()
                        : tl::unexpected(xml.damage("more than " + std::to_string(most) + " <" +
                                                    std::string(xml.name()) + "> in a subject"));
}

std::string shortened(std::string_view name) {
    return std::string(name.substr(0, kLongestName));
}

} // namespace

tl::expected<void, log::FileError> readNumbers(const XmlReader& xml, std::size_t most,
                                               std::vector<float>& into) {
    constexpr std::string_view kSpaces = " \t\r\n";
    const std::string_view text = xml.text();
    into.clear();
    for (std::size_t at = text.find_first_not_of(kSpaces); at < text.size();
         at = text.find_first_not_of(kSpaces, at)) {
        const std::string_view word = text.substr(at, text.find_first_of(kSpaces, at) - at);
        const auto number = numberIn<float>(word);
        if (!number || into.size() == most) {
            return tl::unexpected(xml.damage(
                "<" + std::string(xml.name()) + "> has " +
                (number ? "more than " + std::to_string(most) + " numbers"
                        : "\"" + std::string(word.substr(0, 32)) + "\" where a number should be")));
        }
        into.push_back(*number);
        at += word.size();
    }
    return {};
}

tl::expected<void, log::FileError> Subject::begins(const XmlReader& xml) {
    const std::string_view element = xml.name();
    const std::string_view label = xml.attribute("label");
    if (element == "subject") {
        name = shortened(label);
        colour = xml.attribute("torsoColor").substr(0, 16);
        begin = numberIn<std::int64_t>(xml.attribute("recDateMSecsSinceEpoch"));
        const std::string_view rate = xml.attribute("frameRate");
        rateHz = numberIn<double>(rate).value_or(rate.empty() ? rateHz : 0);
        if (!(rateHz > 0 && rateHz <= kMostHz)) {
            return tl::unexpected(xml.damage("a frame rate of \"" + shortened(rate) + "\" Hz"));
        }
    } else if (element == "segment") {
        const auto id = numberIn<std::uint32_t>(xml.attribute("id"));
        const auto place = static_cast<std::uint32_t>(segments.size() + 1);
        segments.push_back({id && *id > 0 && *id <= 255 ? *id : place, shortened(label)});
        return fits(xml, segments.size(), kMostSegments);
    } else if (element == "point" && !segments.empty()) {
        const std::uint32_t segment = segments.back().id;
        const bool isFirst = points.empty() || points.back().segment != segment;
        points.push_back({static_cast<std::uint16_t>(segment),
                          static_cast<std::uint16_t>(isFirst ? 1 : points.back().point + 1),
                          shortened(label),
                          0,
                          {}});
        return fits(xml, points.size(), kMostPoints);
    } else if (element == "sensor") {
        sensors.push_back(idOf(label));
        return fits(xml, sensors.size(), kMostSegments);
    } else if (element == "joint") {
        joints.emplace_back();
        return fits(xml, joints.size(), kMostSegments);
    } else if (element == "ergonomicJointAngle") {
        ergonomicAngles.push_back(
            {256 * idOf(xml.attribute("parentSegment")), 256 * idOf(xml.attribute("childSegment"))});
        return fits(xml, ergonomicAngles.size(), kMostSegments);
    }
    return {};
}

tl::expected<void, log::FileError> Subject::ends(const XmlReader& xml) {
    const std::string_view element = xml.name();
    if ((element == "pos_b" || element == "pos_s") && !points.empty()) {
        std::vector<float> place;
        if (const auto read = readNumbers(xml, 3, place); !read) {
            return read;
        }
        if (place.size() == 3) {
            std::copy(place.begin(), place.end(), points.back().position.begin());
        }
    } else if (element == "connector1" && !joints.empty()) {
        joints.back().parent = pointIdOf(xml.text());
    } else if (element == "connector2" && !joints.empty()) {
        joints.back().child = pointIdOf(xml.text());
    }
    return {};
}

std::uint32_t Subject::idOf(std::string_view segment) const {
    const auto found = std::find_if(segments.begin(), segments.end(),
                                    [segment](const Segment& one) { return one.name == segment; });
    return found == segments.end() ? 0 : found->id;
}

std::uint32_t Subject::pointIdOf(std::string_view connector) const {
    const std::size_t slash = connector.find('/');
    const std::uint32_t segment = idOf(connector.substr(0, slash));
    const std::string_view point = slash < connector.size() ? connector.substr(slash + 1) : "";
    const auto found = std::find_if(points.begin(), points.end(), [&](const wire::NullPosePoint& one) {
        return one.segment == segment && one.name == point;
    });
    return 256 * segment + (found == points.end() ? 0U : found->point);
}

} // namespace posewire::mvnx
