// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/support/paths.h"

#include <QColor>
#include <QFile>
#include <QImage>
#include <QProcess>
#include <QProcessEnvironment>
#include <QTemporaryDir>
#include <QUdpSocket>

#include <gtest/gtest.h>

#include <cmath>

namespace {

constexpr int kProgramMs = 60'000;

/// A port of this computer that nobody has at the moment.
quint16 freePort() {
    QUdpSocket socket;
    socket.bind(QHostAddress::LocalHost, 0);
    return socket.localPort();
}

/// Runs the window without a display, sends to it, and looks at the picture it takes of itself.
class LivePicture : public testing::Test {
protected:
    void startWindow() {
        QProcessEnvironment environment = QProcessEnvironment::systemEnvironment();
        environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
        environment.insert(QStringLiteral("XDG_RUNTIME_DIR"), m_folder.path());
        m_window.setProcessEnvironment(environment);
        m_window.setProcessChannelMode(QProcess::MergedChannels);
        m_window.start(QStringLiteral(POSEWIRE_PROGRAM),
                       {QStringLiteral("--udp"), m_target, QStringLiteral("--settings"),
                        m_folder.filePath("settings.ini"), QStringLiteral("--theme"), QStringLiteral("dark"),
                        QStringLiteral("--screenshot"), m_picture, QStringLiteral("--after"),
                        QStringLiteral("6"), QStringLiteral("--size"), QStringLiteral("1280x800")});
        ASSERT_TRUE(m_window.waitForStarted(kProgramMs));
    }

    /// Sends until the window has taken its picture.
    QImage sendUntilShot(const QStringList& what) {
        while (m_window.state() != QProcess::NotRunning) {
            QProcess sender;
            sender.start(QStringLiteral(POSEWIRE_CLI_PROGRAM), QStringList{"send", "--to", m_target} + what);
            EXPECT_TRUE(sender.waitForFinished(kProgramMs));
            EXPECT_EQ(sender.exitCode(), 0) << sender.readAllStandardError().toStdString();
            m_window.waitForFinished(100);
        }
        EXPECT_EQ(m_window.exitCode(), 0) << m_window.readAll().toStdString();
        return QImage(m_picture);
    }

    /// Pixels of a hue within 12°, strong enough to be a suit and not a shade of grey, in the middle of the
    /// window.
    static int pixelsOfHue(const QImage& image, int hue) {
        int count = 0;
        for (int y = image.height() / 10; y < image.height() * 9 / 10; ++y) {
            for (int x = image.width() * 3 / 10; x < image.width() * 7 / 10; ++x) {
                const QColor colour = image.pixelColor(x, y).toHsv();
                const int distance = std::abs((colour.hsvHue() - hue + 540) % 360 - 180);
                count += distance <= 12 && colour.hsvSaturation() > 110 && colour.value() > 60;
            }
        }
        return count;
    }

    QTemporaryDir m_folder;
    QString m_target = QStringLiteral("127.0.0.1:%1").arg(freePort());
    QString m_picture = m_folder.filePath("window.png");
    QProcess m_window;
};

constexpr int kFigurePixels = 1'500;
constexpr int kBlueHue = 213;
constexpr int kOrangeHue = 22; // e96417

TEST_F(LivePicture, TwoPerformersSentOverUdpAreSeenInTheirColours) {
    startWindow();
    const QImage picture = sendUntilShot(
        {"--characters", "2", "--rate", "60", "--duration", "2", "--motion", "idle", "--types", "02,12,13"});
    ASSERT_FALSE(picture.isNull());
    RecordProperty("bluePixels", pixelsOfHue(picture, kBlueHue));
    EXPECT_GT(pixelsOfHue(picture, kBlueHue), kFigurePixels);
    EXPECT_GT(pixelsOfHue(picture, kOrangeHue + 6), kFigurePixels);
}

TEST_F(LivePicture, RecordedDatagramsSentOneByOneShowThePersonInOrange) {
    const QString folder = QString::fromStdString(posewire::test::capturesFolder().string() + "/");
    if (!QFile::exists(folder + "mxtp02.bin")) {
        GTEST_SKIP() << "no recorded datagrams at " << folder.toStdString()
                     << ": the captured person is not shown";
    }
    startWindow();
    QProcess sender;
    for (const char* name : {"mxtp12.bin", "mxtp13.bin"}) {
        m_window.waitForFinished(1'500); // gives the window time to open its port
        sender.start(QStringLiteral(POSEWIRE_CLI_PROGRAM),
                     {"send", "--to", m_target, "--file", folder + name});
        ASSERT_TRUE(sender.waitForFinished(kProgramMs));
    }
    const QImage picture = sendUntilShot({"--file", folder + "mxtp02.bin"});
    ASSERT_FALSE(picture.isNull());
    EXPECT_GT(pixelsOfHue(picture, kOrangeHue), kFigurePixels);
}

} // namespace
