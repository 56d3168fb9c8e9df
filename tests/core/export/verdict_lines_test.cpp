// SPDX-License-Identifier: MIT
#include "core/export/reports.h"

#include "tests/core/model/session/session_fixture.h"

#include <nlohmann/json.hpp>

#include <gtest/gtest.h>

#include <map>

/// What follows a session line by line.
namespace posewire::exporting {
namespace {

using namespace std::chrono_literals;
using Json = nlohmann::json;

class VerdictLinesTest : public model::SessionTest {
protected:
    /// Takes in the line that is due, as a program that reads them does.
    void read() {
        follow();
        if (const auto text = m_lines.lineAt(m_session, m_now)) {
            const Json line = Json::parse(*text);
            for (const Json& incident : line["incidents"]) {
                m_known[incident["id"]] = incident;
            }
            for (const Json& number : line.value("gone", Json::array())) {
                m_isAnyGone = m_known.erase(number.get<std::uint64_t>()) != 0;
            }
        }
    }

    VerdictLines m_lines{10ms};
    std::map<std::uint64_t, Json> m_known;
    bool m_isAnyGone = false;
};

TEST_F(VerdictLinesTest, TellOfIncidentsThatCameToNothing) {
    for (std::uint32_t sample = 1; sample <= 400; ++sample) {
        const log::Stamp stamp{100s + sample * 10ms};
        if (sample != 300) {
            send(swayingAt(0, sample), sample, stamp);
            send(wire::CentreOfMass{}, sample, stamp);
        }
        if (sample == 330) {
            EXPECT_EQ(m_known.size(), 1U) << "it is 0.3 s late";
            send(standingAt(0), 300, stamp);
            send(wire::CentreOfMass{}, 300, stamp);
        }
        read();
    }
    EXPECT_TRUE(m_isAnyGone);
    for (const auto& [number, incident] : m_known) {
        EXPECT_EQ(incident["kind"], "reordered") << incident << ": nothing was lost";
    }
}

} // namespace
} // namespace posewire::exporting
