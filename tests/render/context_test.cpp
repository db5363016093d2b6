#include "render/context.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>

#include "render/canvas.h"
#include "render/compare.h"
#include "render/frame.h"
#include "src2d/core/error.h"
#include "tests/render/samples.h"

namespace merge2d {
namespace {

/// Sets a variable of the environment for as long as it lives.
class Variable {
 public:
  Variable(const char* variable, const char* value) : name_(variable) {
    if (const char* before = std::getenv(variable)) before_ = before;
    setenv(variable, value, 1);
  }
  ~Variable() { before_ ? setenv(name_, before_->c_str(), 1) : unsetenv(name_); }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

class ContextTest : public testing::Test {
 protected:
  ~ContextTest() override { chooseContext({}); }

  /// Bodies of all kinds with marks and text, on a context of one kind.
  static Picture draw(ContextKind kind) {
    chooseContext(kind);
    samples::Sample sample;
    sample.box({0, 1}, 2, 1, 0.3);
    sample.disc({2.5, 1}, 0.7, 1.0);
    sample.add({makeBox(1, 1)}, {-2, 1}, -0.2, Motion::Pinned);
    sample.collect(0, {BodyId{0}, BodyId{1}});
    FrameStyle style;
    style.width = 320, style.height = 180;
    style.title = "Contexts";
    style.overlays = parseOverlays("all");
    style.camera.height = 6.0;
    Canvas canvas(style.width, style.height);
    return drawFrame(canvas, sample.snapshot, sample.bodies, style);
  }
};

TEST_F(ContextTest, NamesTheLibraryAndTheDriver) {
  chooseContext(ContextKind::Egl);
  const std::string egl = Context().description();
  EXPECT_EQ(egl.substr(0, 5), "EGL, ");
  EXPECT_NE(egl.find("llvmpipe"), std::string::npos) << "a software driver, not a card: " << egl;
}

#ifdef MERGE2D_HAS_OSMESA
TEST_F(ContextTest, DrawsTheSamePixelsFromEitherLibrary) {
  EXPECT_EQ(draw(ContextKind::Osmesa).rgba, draw(ContextKind::Egl).rgba);
}
#endif

TEST_F(ContextTest, LetsContextsOfBothLibrariesTakeTurns) {
  chooseContext(ContextKind::Egl);
  Canvas one(16, 16);
  chooseContext({});
  Canvas other(16, 16);
  Drawing red, blue;
  red.background = rgb(0xff0000);
  blue.background = rgb(0x0000ff);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(one.draw(red).at(8, 8), rgb(0xff0000));
    EXPECT_EQ(other.draw(blue).at(8, 8), rgb(0x0000ff));
  }
}

TEST_F(ContextTest, RefusesADriverThatMesaDoesNotHave) {
  const Variable driver("GALLIUM_DRIVER", "llvmpip");
  try {
    Context();
    FAIL() << "a context of an unknown driver";
  } catch (const IoError& error) {
    EXPECT_STREQ(error.what(),
                 "GALLIUM_DRIVER is 'llvmpip', but Mesa's software drivers are llvmpipe and "
                 "softpipe (did you mean 'llvmpipe'?); unset it");
  }
}

}  // namespace
}  // namespace merge2d
