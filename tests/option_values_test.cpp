#include "viewer/option_values.h"

#include <gtest/gtest.h>

#include "viewer/errors.h"

using namespace lumivec;

namespace {

// The message of the UsageError that the call throws.
template <typename Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const UsageError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace

TEST(ParseNumber, TakesDecimalsAndSigns) {
  EXPECT_EQ(parse_number("--x", "-1.5", -2, 2), -1.5);
  EXPECT_EQ(parse_number("--x", "+1e-1", -2, 2), 0.1);
}
TEST(ParseNumber, TakesItsLimits) {
  EXPECT_EQ(parse_number("--x", "2", -2, 2), 2.0);
}

TEST(ParseNumber, RefusesWhatIsNone) {
  EXPECT_EQ(refusal([] { parse_number("--x", "two", 0, 9); }), "--x: 'two' is not a number");
  EXPECT_EQ(refusal([] { parse_number("--x", "", 0, 9); }), "--x: '' is not a number");
  EXPECT_EQ(refusal([] { parse_number("--x", "1 ", 0, 9); }), "--x: '1 ' is not a number");
  EXPECT_EQ(refusal([] { parse_number("--x", "1,5", 0, 9); }), "--x: '1,5' is not a number");
}
TEST(ParseNumber, RefusesNaNAndInfinity) {
  EXPECT_EQ(refusal([] { parse_number("--x", "nan", 0, 9); }), "--x: 'nan' is not a finite number");
  EXPECT_EQ(refusal([] { parse_number("--x", "inf", 0, 9); }), "--x: 'inf' is not a finite number");
  EXPECT_EQ(refusal([] { parse_number("--x", "1e999", 0, 9); }),
            "--x: '1e999' is not a finite number");
}
TEST(ParseNumber, RefusesWhatIsOutOfRange) {
  EXPECT_EQ(refusal([] { parse_number("--x", "1.01", 0, 1); }),
            "--x: 1.01 is out of range; give a number from 0 to 1");
  EXPECT_EQ(refusal([] { parse_number_above("--x", "0", 0, 100); }),
            "--x: 0 is out of range; give a number above 0, at most 100");
}

TEST(ParseWhole, TakesTheLargest) {
  EXPECT_EQ(parse_whole("--seed", "18446744073709551615", 0, ~0ull), ~0ull);
}
TEST(ParseWhole, RefusesFractionsNegativesAndOverflow) {
  EXPECT_EQ(refusal([] { parse_whole("--spp", "1.5", 1, 9); }),
            "--spp: '1.5' is not a whole number");
  EXPECT_EQ(refusal([] { parse_whole("--spp", "-1", 1, 9); }),
            "--spp: -1 is out of range; give a number from 1 to 9");
  EXPECT_EQ(refusal([] { parse_whole("--spp", "18446744073709551616", 1, 9); }),
            "--spp: 18446744073709551616 is out of range; give a number from 1 to 9");
}

TEST(ParseSize, TakesTwoNumbers) {
  const PictureSize size = parse_size("--size", "640x480");
  EXPECT_EQ(size.width, 640);
  EXPECT_EQ(size.height, 480);
}
TEST(ParseSize, TakesOneNumberForASquare) {
  const PictureSize size = parse_size("--size", "65536");
  EXPECT_EQ(size.width, 65536);
  EXPECT_EQ(size.height, 65536);
}
TEST(ParseSize, RefusesZeroAndTooMuch) {
  EXPECT_EQ(refusal([] { parse_size("--size", "0x5"); }),
            "--size: 0 is out of range; give a number from 1 to 65536");
  EXPECT_EQ(refusal([] { parse_size("--size", "5x65537"); }),
            "--size: 65537 is out of range; give a number from 1 to 65536");
}
TEST(ParseSize, RefusesOtherForms) {
  for (const char* text : {"", "x", "5x", "x5", "5x5x5", "-5x5", "5*5", "5.0x5"}) {
    EXPECT_NE(refusal([=] { parse_size("--size", text); }).find("is not a size"), std::string::npos)
        << text;
  }
}

TEST(ParseFilter, KnowsTheFour) {
  for (const char* name : {"box", "tent", "gaussian", "blackman-harris"}) {
    EXPECT_EQ(filter_name(parse_filter("--filter", name)), name);
  }
}
TEST(ParseFilter, SuggestsTheNearest) {
  EXPECT_EQ(refusal([] { parse_filter("--filter", "gausian"); }),
            "--filter: there is no filter 'gausian'; did you mean 'gaussian'?");
  EXPECT_EQ(refusal([] { parse_filter("--filter", "blackman"); }),
            "--filter: there is no filter 'blackman'; did you mean 'blackman-harris'?");
}

TEST(ParseTerms, ReadsAList) {
  EXPECT_EQ(parse_terms("--terms", "caustic,emitted"), 0b10001u);
  EXPECT_EQ(terms_text(0b10001u), "emitted,caustic");
}
TEST(ParseTerms, RefusesUnknownRepeatedAndEmptyNames) {
  EXPECT_EQ(refusal([] { parse_terms("--terms", "direct,emited"); }),
            "--terms: there is no term 'emited'; did you mean 'emitted'?");
  EXPECT_EQ(refusal([] { parse_terms("--terms", "direct,direct"); }),
            "--terms: 'direct' is there twice; name it once");
  EXPECT_EQ(refusal([] { parse_terms("--terms", "direct,"); }),
            "--terms: there is no term ''; known are emitted, specular, direct, indirect, caustic");
}

TEST(FindByNameOrIndex, PrefersNames) {
  EXPECT_EQ(find_by_name_or_index("--camera", "1", {"a", "b", "1"}, "camera"), 2);
  EXPECT_EQ(find_by_name_or_index("--camera", "1", {"a", "b", "c"}, "camera"), 1);
}
TEST(FindByNameOrIndex, SaysWhatThereIs) {
  EXPECT_EQ(refusal([] {
              find_by_name_or_index("--camera", "2", {"a", "b"}, "camera");
            }),
            "--camera: there is no camera 2; there are 2, counted from 0");
  EXPECT_EQ(refusal([] {
              find_by_name_or_index("--camera", "fornt", {"front", ""}, "camera");
            }),
            "--camera: there is no camera 'fornt'; did you mean 'front'?");
  EXPECT_EQ(refusal([] {
              find_by_name_or_index("--camera", "x", {"", ""}, "camera");
            }),
            "--camera: there is no camera 'x'; none has a name: give a number from 0 to 1");
}

TEST(ParsePair, NeedsTwoNames) {
  EXPECT_EQ(parse_pair("--map", "a=b").second, "b");
  for (const char* text : {"a", "=b", "a=", ""}) {
    EXPECT_NE(refusal([=] { parse_pair("--map", text); }).find("NAME=NAME"), std::string::npos);
  }
}
