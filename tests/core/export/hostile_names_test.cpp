// SPDX-License-Identifier: MIT
#include "core/export/formats.h"
#include "core/model/body/null_pose.h"
#include "core/model/session/roster.h"
#include "core/model/session/verdict.h"
#include "core/wire/text.h"
#include "tests/core/model/session/session_fixture.h"
#include "tests/support/hostile_text.h"

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>

namespace posewire::exporting {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;
using testing::Not;

/// Sends a name in every place that has one, and reads what is saved then.
class HostileNamesSavedTest : public model::SessionTest, public testing::WithParamInterface<std::string> {
protected:
    HostileNamesSavedTest() {
        for (const std::string& name : {GetParam(), GetParam() + "2"}) {
            wire::MetaData metadata;
            metadata.text = "name:" + name + "\n";
            send(metadata, 0, kStart);
            metadata.text = name + ":" + name.substr(0, 1'000) + "\n";
            send(metadata, 0, kStart);
        }
        m_part.segments = {{GetParam(), {0, 0, 1}}};
        m_part.points = {{1, 1, GetParam().substr(0, 2'000), 0, {0, 0, 0}}};
        m_props.props = {{24, GetParam()}};
        m_history.add(m_part, 0x80, 1, kStart);
        for (std::uint32_t sample = 0; sample < 200; ++sample) {
            if (sample % 20 != 10) {
                send(swayingAt(0, sample), sample, kStart + sample * 4ms);
            }
        }
        sendBytes(std::as_bytes(std::span("GET /", 5)), kStart + 1s, GetParam());
        follow();
    }
    [[nodiscard]] NullPoseSheet sheet() const {
        return {m_session.roster().displayName({m_session.roster().senders()[0].id, 0}), m_history.at(1),
                nullptr, &m_props};
    }

    static constexpr log::Stamp kStart{1'700'000'000s};
    wire::NullPose m_part;
    wire::PropInformation m_props;
    model::NullPoseHistory m_history;
};

TEST_P(HostileNamesSavedTest, AreTextInReports) {
    const std::string html = streamReport(m_session, {});
    EXPECT_EQ(test::harmIn(html), "");
    for (const char* markup : {"<img", "<script", "file:///etc/hostname\">"}) {
        EXPECT_THAT(html, Not(HasSubstr(markup)));
    }
}

TEST_P(HostileNamesSavedTest, AreNoFormulasInTables) {
    std::vector<const model::Incident*> events;
    for (const model::Incident& event : m_session.verdicts().incidents().all()) {
        events.push_back(&event);
    }
    ASSERT_FALSE(events.empty());
    for (std::string csv : {eventsCsv({m_session, events}), nullPoseCsv(sheet())}) {
        std::erase(csv, '\r'); // the ends of lines
        EXPECT_EQ(test::harmIn(csv), "");
        for (const char* formula : {",=", ",@", ",+", ",\"=", ",\"@", "\n=", "\n@"}) {
            EXPECT_THAT(csv, Not(HasSubstr(formula)));
        }
    }
}

TEST_P(HostileNamesSavedTest, AreWhatWasSentInJson) {
    const auto json = nlohmann::json::parse(nullPoseJson(sheet()));
    const bool isText = wire::firstInvalidUtf8(GetParam()) == GetParam().size();
    if (isText) {
        EXPECT_EQ(json["character"], GetParam() + "2");
        EXPECT_EQ(json["props"][0]["name"], GetParam());
        if (GetParam().size() <= model::NullPose::kMostNameBytes) {
            EXPECT_EQ(json["segments"][0]["name"], GetParam());
        }
        const auto report = nlohmann::json::parse(monitorReport(m_session, {}));
        EXPECT_EQ(report["sources"][0]["characters"][0]["name"], GetParam() + "2");
    }
}

INSTANTIATE_TEST_SUITE_P(Names, HostileNamesSavedTest, testing::ValuesIn(test::hostileNames()),
                         [](const auto& name) { return std::to_string(name.index); });

} // namespace
} // namespace posewire::exporting
