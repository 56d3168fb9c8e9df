// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/group_memberships.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::net {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class GroupMembershipsTest : public ::testing::Test {
protected:
    GroupMembershipsTest() {
        for (const QNetworkInterface& interface : QNetworkInterface::allInterfaces()) {
            if (interface.flags().testFlag(QNetworkInterface::IsLoopBack) &&
                interface.flags().testFlag(QNetworkInterface::IsUp)) {
                loopback = {interface};
            }
        }
        memberships.add(QHostAddress(QStringLiteral("239.1.1.1")),
                        [this](const QHostAddress&, const QNetworkInterface& interface, bool joins) {
                            done.push_back((joins ? "join " : "leave ") +
                                           interface.humanReadableName().toStdString());
                            return joins ? refusal : std::string();
                        });
    }

    [[nodiscard]] std::string name() const { return loopback[0].humanReadableName().toStdString(); }

    QList<QNetworkInterface> loopback;
    GroupMemberships memberships;
    std::vector<std::string> done;
    std::string refusal;
};

TEST_F(GroupMembershipsTest, FollowInterfacesThatComeAndGo) {
    if (loopback.isEmpty()) {
        GTEST_SKIP() << "no loopback interface is up here";
    }
    memberships.follow({});
    EXPECT_EQ(memberships.text(), "listening; 239.1.1.1 joined on no interface");
    EXPECT_THAT(memberships.problem(), HasSubstr("239.1.1.1 is joined on no interface; connect the network"));
    memberships.follow(loopback);
    memberships.follow(loopback);
    EXPECT_THAT(done, ElementsAre("join " + name())) << "once";
    EXPECT_EQ(memberships.text(), "listening; 239.1.1.1 joined on 1 interface (" + name() + ")");
    EXPECT_EQ(memberships.problem(), "");
    memberships.follow({});
    memberships.follow(loopback);
    EXPECT_THAT(done, ElementsAre("join " + name(), "leave " + name(), "join " + name()));
}

TEST_F(GroupMembershipsTest, SayThatTheOwnAddressHasGoneUntilItIsBack) {
    if (loopback.isEmpty()) {
        GTEST_SKIP() << "no loopback interface is up here";
    }
    GroupMemberships none;
    EXPECT_TRUE(none.isEmpty());
    none.listensOn(QHostAddress(QHostAddress::LocalHost));
    EXPECT_FALSE(none.isEmpty());
    none.follow({});
    EXPECT_EQ(none.problem(), "") << "it may be one that no interface is known to have";
    none.follow(loopback);
    EXPECT_EQ(none.problem(), "");
    none.follow({});
    EXPECT_THAT(none.problem(), HasSubstr("no interface that is up has the address 127.0.0.1 any more"));
    none.follow(loopback);
    EXPECT_EQ(none.problem(), "");
    EXPECT_EQ(none.text(), "listening");
}

TEST_F(GroupMembershipsTest, HoldToTheInterfaceThatAGroupNames) {
    if (loopback.isEmpty()) {
        GTEST_SKIP() << "no loopback interface is up here";
    }
    GroupMemberships named;
    const auto note = [this](const QHostAddress& group, const QNetworkInterface&, bool) {
        done.push_back(group.scopeId().toStdString());
        return std::string();
    };
    named.add(QHostAddress(QStringLiteral("ff02::1%nope")), note);
    named.add(QHostAddress("ff02::2%" + loopback[0].name()), note);
    named.follow(loopback);
    const bool hasIpv6 = !done.empty();
    EXPECT_THAT(named.problem(), HasSubstr("ff02::1%nope: there is no interface nope here"));
    EXPECT_THAT(named.problem(), HasSubstr("or connect that one, and the group is joined at once"));
    if (hasIpv6) {
        EXPECT_THAT(done, ElementsAre(loopback[0].name().toStdString()));
    }
}

TEST_F(GroupMembershipsTest, SayWhereAGroupCouldNotBeJoinedAndTryAgain) {
    if (loopback.isEmpty()) {
        GTEST_SKIP() << "no loopback interface is up here";
    }
    refusal = "No buffer space available";
    memberships.follow(loopback);
    EXPECT_EQ(memberships.problem(),
              "239.1.1.1 could not be joined on " + name() + ": No buffer space available");
    refusal.clear();
    memberships.follow(loopback);
    EXPECT_EQ(memberships.problem(), "");
    EXPECT_THAT(done, ElementsAre("join " + name(), "join " + name()));
}

} // namespace
} // namespace posewire::net
