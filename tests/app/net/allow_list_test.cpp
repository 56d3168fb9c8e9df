// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/allow_list.h"

#include "tests/app/net/net_fixture.h"
#include "tests/support/loopback.h"

#include <QNetworkInterface>
#include <QUdpSocket>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::net {
namespace {

using ::testing::HasSubstr;

bool allows(const AllowList& list, const char* address) {
    return list.allows(QHostAddress(QString::fromLatin1(address)));
}

TEST(AllowList, WithoutEntriesItIsEveryone) {
    EXPECT_TRUE(AllowList().isEveryone());
    EXPECT_TRUE(AllowList::of({})->isEveryone());
    EXPECT_TRUE(allows({}, "192.0.2.1"));
}

TEST(AllowList, KnowsAddressesAndNetsOfBothKinds) {
    const auto list = AllowList::of({"192.168.1.20", "10.0.0.0/8", "fd00::/8", "[2001:db8::5]"});
    ASSERT_TRUE(list) << list.error().text;
    EXPECT_FALSE(list->isEveryone());
    for (const char* address :
         {"192.168.1.20", "::ffff:192.168.1.20", "10.255.0.1", "fd12::1", "2001:db8::5"}) {
        EXPECT_TRUE(allows(*list, address)) << address;
    }
    for (const char* address : {"192.168.1.21", "11.0.0.1", "127.0.0.1", "fe80::1", "2001:db8::6", "::1"}) {
        EXPECT_FALSE(allows(*list, address)) << address;
    }
}

TEST(AllowList, KnowsNetsOfMappedAddresses) {
    const auto list = AllowList::of({"::ffff:10.9.0.0/120"});
    ASSERT_TRUE(list) << list.error().text;
    EXPECT_TRUE(allows(*list, "10.9.0.2"));
    EXPECT_TRUE(allows(*list, "::ffff:10.9.0.2"));
    EXPECT_FALSE(allows(*list, "10.9.1.2"));
    EXPECT_TRUE(allows(*AllowList::of({"::/0"}), "fd00::1"));
    EXPECT_FALSE(allows(*AllowList::of({"::/0"}), "10.9.0.2"));
}

TEST(AllowList, RefusesAnInterfaceThatIsNotHereAndHeedsOneThatIs) {
    const auto refused = AllowList::of({"fe80::1%nope"});
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().text,
                HasSubstr("fe80::1%nope: there is no interface nope here; write one of"));
    EXPECT_THAT(refused.error().text, HasSubstr("or leave it out"));
    const AllowList meanwhile = AllowList::withoutNames({"fe80::1%nope"});
    EXPECT_FALSE(meanwhile.isEveryone());
    EXPECT_FALSE(allows(meanwhile, "fe80::1")) << "that interface may come yet";
    const auto interfaces = QNetworkInterface::allInterfaces();
    if (interfaces.isEmpty()) {
        GTEST_SKIP() << "there are no interfaces here";
    }
    const std::string name = interfaces[0].name().toStdString();
    const std::string index = std::to_string(interfaces[0].index());
    const auto list = AllowList::of({"fe80::1%" + name});
    ASSERT_TRUE(list) << list.error().text;
    EXPECT_TRUE(allows(*list, ("fe80::1%" + name).c_str()));
    EXPECT_TRUE(allows(*list, ("fe80::1%" + index).c_str())) << "as the kernel says it";
    EXPECT_FALSE(allows(*list, "fe80::1%4711"));
    EXPECT_FALSE(allows(*list, ("fe80::2%" + name).c_str()));
    EXPECT_TRUE(allows(*AllowList::of({"fe80::1"}), ("fe80::1%" + name).c_str())) << "on any";
}

TEST(AllowList, LooksUpNames) {
    const auto list = AllowList::of({"localhost"});
    ASSERT_TRUE(list) << list.error().text;
    EXPECT_TRUE(allows(*list, "127.0.0.1"));
    EXPECT_FALSE(allows(*list, "192.0.2.1"));
    const AllowList meanwhile = AllowList::withoutNames({"localhost", "192.0.2.1"});
    EXPECT_FALSE(meanwhile.isEveryone());
    EXPECT_FALSE(allows(meanwhile, "127.0.0.1")) << "not known yet";
    EXPECT_TRUE(allows(meanwhile, "192.0.2.1"));
}

TEST(AllowList, SaysWhatIsNoEntry) {
    for (const char* entry :
         {"", "10.0.0", "10.0.0.256", "10.0.0.0/33", "stage left", "fd00::/129", "a/b", "1"}) {
        const auto list = AllowList::of({"127.0.0.1", entry});
        ASSERT_FALSE(list) << entry;
        EXPECT_THAT(list.error().text, HasSubstr("is not a host or a net")) << entry;
        EXPECT_FALSE(problemWithEntry(entry).empty());
    }
    EXPECT_EQ(problemWithEntry("studio-2.local"), "");
    EXPECT_THAT(AllowList::of({"no-such-host.invalid"}).error().text, HasSubstr("no-such-host.invalid"));
}

class ListeningToSomeTest : public ::testing::TestWithParam<ReceivePath> {
protected:
    [[nodiscard]] static ReceiverOptions options() {
        ReceiverOptions options;
        options.path = GetParam();
        return options;
    }
    void send(const char* from, std::size_t count) {
        QUdpSocket socket;
        ASSERT_TRUE(socket.bind(QHostAddress(QString::fromLatin1(from)), 0));
        const auto bytes = numbered(100, 1);
        for (std::size_t i = 0; i < count; ++i) {
            socket.writeDatagram(reinterpret_cast<const char*>(bytes.data()), 100, QHostAddress::LocalHost,
                                 receiving.endpoint().port);
        }
    }
    Receiving receiving{options()};
};

TEST_P(ListeningToSomeTest, OthersAreCountedAndNotLogged) {
    if (!posewire::test::hasManyLoopbackAddresses()) {
        GTEST_SKIP() << "all senders of this system are 127.0.0.1";
    }
    receiving.receiver->listenTo(*AllowList::of({"127.0.0.2"}));
    send("127.0.0.3", 20);
    send("127.0.0.2", 5);
    send("127.0.0.3", 20);
    ASSERT_TRUE(eventually([&] { return receiving.totals().refusedDatagrams == 40; }));
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 5; }));
    EXPECT_EQ(receiving.totals().datagrams, 5U);
    EXPECT_EQ(receiving.receiver->inputs()[0].refusedDatagrams, 40U);
    EXPECT_EQ(receiving.log.senders().size(), 1U) << "no place is taken by those who are not listened to";
}

TEST_P(ListeningToSomeTest, TheListChangesWhileItRuns) {
    send("127.0.0.3", 1);
    ASSERT_TRUE(eventually([&] { return receiving.packets() == 1; }));
    receiving.receiver->listenTo(*AllowList::of({"127.0.0.2"}));
    send("127.0.0.3", 1);
    ASSERT_TRUE(eventually([&] { return receiving.totals().refusedDatagrams == 1; }));
    receiving.receiver->listenTo({});
    send("127.0.0.3", 1);
    EXPECT_TRUE(eventually([&] { return receiving.packets() == 2; }));
}

INSTANTIATE_TEST_SUITE_P(Paths, ListeningToSomeTest,
                         ::testing::Values(ReceivePath::Native, ReceivePath::Portable), &pathName);

} // namespace
} // namespace posewire::net
