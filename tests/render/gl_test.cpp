// SPDX-License-Identifier: MIT
#include "render/gl/framebuffer.h"
#include "render/gl/program.h"
#include "render/gl/ring.h"
#include "render/offscreen.h"
#include "tests/support/baseline.h"

#include <array>
#include <optional>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace posewire::render::gl {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kTooLarge = 1 << 20;

/// A current context, and nothing drawn.
class GlTest : public ::testing::Test {
protected:
    void SetUp() override {
        render::test::useSoftwareOpenGl();
        auto created = OffscreenContext::create();
        ASSERT_TRUE(created.has_value()) << created.error();
        m_context.emplace(std::move(*created));
    }

    OffscreenContext& context() { return *m_context; }

    static std::string errorOf(std::string_view vertex, std::string_view fragment) {
        const std::array<std::string_view, 1> vertexParts{vertex};
        const std::array<std::string_view, 1> fragmentParts{fragment};
        const auto program = Program::create({"broken", vertexParts, fragmentParts});
        return program ? std::string() : program.error();
    }

private:
    std::optional<OffscreenContext> m_context;
};

TEST(Ring, GivesEachViewOfThePicturesThatMayBeDrawnOneOfItsOwn) {
    int made = 0;
    Ring<int, 4> ring([&made] { return made++; });
    std::set<int> written;
    for (std::size_t i = 0; i < 4 * decltype(ring)::kPictures; ++i) {
        EXPECT_TRUE(written.insert(ring.next()).second) << i;
        EXPECT_TRUE(written.contains(ring.current()));
    }
    EXPECT_TRUE(written.contains(ring.next())) << "that of the oldest picture";
}

TEST_F(GlTest, NamesProgramAndStageWithTheCompilersOwnText) {
    const std::string good = "void main() { gl_Position = vec4(0.0); }";
    EXPECT_THAT(errorOf(good, "void main() { undeclared = 1.0; }"),
                AllOf(HasSubstr("program broken, fragment shader"), HasSubstr("undeclared")));
    EXPECT_THAT(errorOf("void main() { missing(); }", "void main() {}"),
                AllOf(HasSubstr("program broken, vertex shader"), HasSubstr("missing")));
}

TEST_F(GlTest, SaysWhatDoesNotLink) {
    const std::string error =
        errorOf("out vec3 place; void main() { place = vec3(1.0); gl_Position = vec4(0.0); }",
                "in vec4 place; out vec4 colour; void main() { colour = place; }");
    EXPECT_THAT(error, AllOf(HasSubstr("program broken, linking"), HasSubstr("place")));
}

TEST_F(GlTest, SaysWhichFramebufferIsRefused) {
    const auto large = Framebuffer::create(kTooLarge, 4);
    ASSERT_FALSE(large.has_value());
    EXPECT_THAT(large.error(), HasSubstr("1048576 x 4 pixels and 0 samples"));
    const auto sampled = Framebuffer::create(16, 16, 4096);
    ASSERT_FALSE(sampled.has_value());
    EXPECT_THAT(sampled.error(), HasSubstr("4096 samples"));
    EXPECT_FALSE(
        Framebuffer::over(Texture::create2D(Texture::Format::Depth24, kTooLarge, 4), true).has_value());
}

TEST_F(GlTest, TakesOneSampleForNoMultisampling) {
    const auto framebuffer = Framebuffer::create(16, 8, 1);
    ASSERT_TRUE(framebuffer.has_value()) << framebuffer.error();
    EXPECT_EQ(framebuffer->samples(), 0);
    EXPECT_EQ(framebuffer->width(), 16);
    EXPECT_EQ(framebuffer->height(), 8);
}

TEST_F(GlTest, ReadsBackWhatABufferHolds) {
    Buffer buffer = Buffer::create();
    const std::array<float, 4> sent{1.0F, -2.0F, 0.5F, 8.0F};
    buffer.upload(std::span<const float>(sent), Buffer::Usage::Static);
    EXPECT_EQ(buffer.size(), sizeof(sent));
    std::array<float, 4> read{};
    buffer.read(std::as_writable_bytes(std::span(read)));
    EXPECT_EQ(read, sent);
}

TEST_F(GlTest, MovesTheNameOfAnObject) {
    Buffer first = Buffer::create();
    const unsigned name = first.name();
    ASSERT_NE(name, 0U);
    Buffer second = std::move(first);
    EXPECT_EQ(second.name(), name);
    Buffer third = Buffer::create();
    third = std::move(second);
    EXPECT_EQ(third.name(), name);
}

TEST_F(GlTest, HandsAContextToAnotherThread) {
    context().doneCurrent();
    bool works = false;
    std::thread worker([&] {
        works = context().makeCurrent() && Framebuffer::create(8, 8).has_value();
        context().doneCurrent();
    });
    worker.join();
    EXPECT_TRUE(works);
    EXPECT_TRUE(context().makeCurrent());
}

} // namespace
} // namespace posewire::render::gl
