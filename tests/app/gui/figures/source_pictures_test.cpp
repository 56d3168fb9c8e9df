// SPDX-License-Identifier: GPL-3.0-or-later
// Every overlay and every source of poses, in both themes: the same walker at the same moment.
#include "app/gui/theme/theme.h"
#include "app/gui/viewport/overlays.h"
#include "core/model/body/segments.h"
#include "core/model/session/roster.h"
#include "tests/app/gui/figures/figure_studio.h"

#include <string>
#include <tuple>

namespace posewire::gui {
namespace {

constexpr int kWidth = 300;
constexpr int kHeight = 380;
constexpr std::uint64_t kMoment = 545;

const std::string kThemes[] = {"light", "dark"};

void useTheme(const std::string& name) {
    applyTheme(*qApp, name == "dark" ? ThemeChoice::Dark : ThemeChoice::Light);
}

class SmallPictures : public FigureStudio {
protected:
    /// The frames before the moment, for what is drawn of them.
    void performUntilMoment(const std::vector<std::uint8_t>& types, std::uint64_t before) {
        performer::Performer performer = walker(types);
        perform(performer, 0);
        for (std::uint64_t frame = kMoment - before; frame <= kMoment; ++frame) {
            perform(performer, frame);
        }
    }
    void expectPicture(const Overlays& overlays, const std::string& name) {
        SceneFrame frame = frameOf(AxesMode::None, overlays);
        ASSERT_FALSE(frame.figures.empty());
        frame.camera.target.z = 0.85F;
        frame.camera.distance = 4.6F;
        render::test::expectMatchesBaseline(shoot(std::move(frame), kWidth, kHeight), name);
    }
};

class OverlayPictures : public SmallPictures,
                        public testing::WithParamInterface<std::tuple<std::size_t, std::string>> {
protected:
    void SetUp() override {
        SmallPictures::SetUp();
        useTheme(std::get<1>(GetParam()));
    }
};

TEST_P(OverlayPictures, AreAsLookedAt) {
    const auto& [place, theme] = GetParam();
    const OverlayEntry& entry = kOverlayTable[place];
    performUntilMoment({2, 3, 12, 13, 20, 21, 23, 24}, 120);
    const model::CharacterKey key = m_session.roster().listed().front()->key;
    const int segment = entry.overlay == Overlay::JointAngles ? model::segment::kRightLowerLeg : -1;
    m_session.setSelection({key.sender, key, segment});
    Overlays on;
    on.toggle(entry.overlay);
    expectPicture(on, std::string("overlay_") + entry.key + "_" + theme);
}

// From 1: segment names are words alone, which are not drawn by OpenGL.
INSTANTIATE_TEST_SUITE_P(All, OverlayPictures,
                         testing::Combine(testing::Range<std::size_t>(1, kOverlayCount),
                                          testing::ValuesIn(kThemes)),
                         [](const auto& each) {
                             return std::string(kOverlayTable[std::get<0>(each.param)].key) + "_" +
                                    std::get<1>(each.param);
                         });

struct Source {
    const char* name;
    std::vector<std::uint8_t> types;
};

void PrintTo(const Source& source, std::ostream* out) {
    *out << source.name;
}

class SourcePictures : public SmallPictures,
                       public testing::WithParamInterface<std::tuple<Source, std::string>> {
protected:
    void SetUp() override {
        SmallPictures::SetUp();
        useTheme(std::get<1>(GetParam()));
    }
};

TEST_P(SourcePictures, AreAsLookedAt) {
    const auto& [source, theme] = GetParam();
    performUntilMoment(source.types, 2);
    expectPicture({}, std::string("source_") + source.name + "_" + theme);
}

INSTANTIATE_TEST_SUITE_P(
    All, SourcePictures,
    testing::Combine(testing::Values(Source{"01", {1, 13}}, Source{"02", {2, 13}}, Source{"05", {5, 13}},
                                     Source{"21", {13, 21}}, Source{"22", {13, 22}}, Source{"03", {3, 13}},
                                     Source{"21_22", {13, 21, 22}}, Source{"02_alone", {2}}),
                     testing::ValuesIn(kThemes)),
    [](const auto& each) {
        return std::string(std::get<0>(each.param).name) + "_" + std::get<1>(each.param);
    });

} // namespace
} // namespace posewire::gui
