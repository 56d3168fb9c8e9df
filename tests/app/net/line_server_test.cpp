// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/net/line_server.h"

#include <QCoreApplication>
#include <QFile>
#include <QLocalSocket>
#include <QTcpSocket>
#include <QTemporaryDir>

#include <gtest/gtest.h>

#include <memory>

namespace posewire::net {
namespace {

template <class Condition>
bool comesTrue(Condition&& condition) {
    for (int i = 0; i < 5000 && !condition(); ++i) {
        QCoreApplication::processEvents(QEventLoop::AllEvents | QEventLoop::WaitForMoreEvents, 10);
    }
    return condition();
}

std::unique_ptr<QTcpSocket> connected(const LineServer& server) {
    auto socket = std::make_unique<QTcpSocket>();
    const auto endpoint = parseTarget(server.place());
    socket->connectToHost(QString::fromStdString(endpoint->host), endpoint->port);
    return socket;
}

TEST(LineServer, SendsEachLineToAllWhoAreThere) {
    const auto server = LineServer::listen("0");
    ASSERT_TRUE(server) << server.error().text;
    EXPECT_TRUE((*server)->place().starts_with("127.0.0.1:"));
    const auto first = connected(**server);
    const auto second = connected(**server);
    ASSERT_TRUE(comesTrue([&] { return (*server)->receivers() == 2; }));
    (*server)->send("one");
    (*server)->send("two");
    const QByteArray both("one\ntwo\n");
    ASSERT_TRUE(comesTrue(
        [&] { return first->bytesAvailable() == both.size() && second->bytesAvailable() == both.size(); }));
    EXPECT_EQ(first->readAll(), both);
    EXPECT_EQ(second->readAll(), both);
    EXPECT_EQ((*server)->sent(), 4U);
    second->disconnectFromHost();
    EXPECT_TRUE(comesTrue([&] { return (*server)->receivers() == 1; }));
}

TEST(LineServer, LeavesOutLinesForWhoDoesNotReadAndForNobodyElse) {
    const auto server = LineServer::listen("0");
    ASSERT_TRUE(server) << server.error().text;
    const auto slow = connected(**server);
    slow->setReadBufferSize(1);
    const auto quick = connected(**server);
    ASSERT_TRUE(comesTrue([&] { return (*server)->receivers() == 2; }));
    const std::string line(100'000, 'x');
    qint64 read = 0;
    std::uint64_t lines = 0;
    for (; (*server)->skipped() < 100; ++lines) {
        ASSERT_LT(lines, 5000U);
        (*server)->send(line);
        const auto all = static_cast<qint64>((lines + 1) * (line.size() + 1));
        ASSERT_TRUE(comesTrue([&] {
            read += quick->readAll().size();
            return read == all;
        }));
    }
    EXPECT_EQ((*server)->sent() + (*server)->skipped(), 2 * lines);
    // What it gets is whole lines, later too.
    slow->setReadBufferSize(0);
    QByteArray got;
    const auto isWhole = [&] {
        got += slow->readAll();
        return static_cast<std::uint64_t>(got.size()) == ((*server)->sent() - lines) * (line.size() + 1);
    };
    EXPECT_TRUE(comesTrue(isWhole));
    EXPECT_EQ(got.count('\n'), static_cast<qsizetype>((*server)->sent() - lines));
    EXPECT_TRUE(got.endsWith("x\n"));
}

TEST(LineServer, SaysWhyItCannotBeAtAPlace) {
    const auto server = LineServer::listen("0");
    ASSERT_TRUE(server);
    const auto second = LineServer::listen((*server)->place());
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().kind, NetError::Kind::PortInUse);
    EXPECT_EQ(LineServer::listen("nonsense:").error().kind, NetError::Kind::BadEndpoint);
}

#ifdef Q_OS_UNIX
TEST(LineServer, IsAtAPathThatNobodyElseHas) {
    const QTemporaryDir folder;
    const std::string path = folder.filePath(QStringLiteral("poses")).toStdString();
    const auto server = LineServer::listen("unix:" + path);
    ASSERT_TRUE(server) << server.error().text;
    EXPECT_FALSE(LineServer::listen("unix:" + path)) << "one is there";
    QLocalSocket receiver;
    receiver.connectToServer(QString::fromStdString(path));
    ASSERT_TRUE(comesTrue([&] { return (*server)->receivers() == 1; }));
    (*server)->send("one");
    ASSERT_TRUE(comesTrue([&] { return receiver.bytesAvailable() == 4; }));
    EXPECT_EQ(receiver.readAll(), "one\n");

    const QString other = folder.filePath(QStringLiteral("letter"));
    QFile letter(other);
    ASSERT_TRUE(letter.open(QIODevice::WriteOnly));
    letter.write("Dear Ana");
    letter.close();
    EXPECT_FALSE(LineServer::listen("unix:" + other.toStdString()));
    ASSERT_TRUE(letter.open(QIODevice::ReadOnly));
    EXPECT_EQ(letter.readAll(), "Dear Ana");
}
#endif

} // namespace
} // namespace posewire::net
