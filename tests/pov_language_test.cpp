// The scene language: what it means, and that no scene can make its reader crash, hang or grow.
#include "tests/pov_file.h"

namespace {

// How many objects a scene makes.
std::size_t objects_of(const std::string& scene) {
  return PovFile(scene).load().instances.size();
}

// The radius of the only sphere tells a number of the language.
double number_of(const std::string& before, const std::string& number) {
  const auto scene = PovFile(before + "\nsphere { 0, " + number + " }").load();
  return scene.instances.at(0).object_to_world[0][0];
}

// ---- heads of directives that macros tear apart ------------------------------------------------

TEST(PovLanguage, AMacroMayNotCloseTheParenthesisOfADirective) {
  const std::string words = "parentheses of a directive end in another";
  expect_error("#macro M() 0) #end #if (M()", words);
  expect_error("#macro M() 0) sphere { 0, 1 } #end #while (M()", words);
  expect_error("#macro M() 0) #end #switch (M() #case (1) #end", words);
  expect_error("#macro M() 1, 2) #end #for (I, M()", words);
  expect_error("#macro M() 1) #end #switch (0) #case (M() #end", words);
  expect_error("#macro M() #if (1 #end #end M() ) #end", words);
}

TEST(PovLanguage, AHeadMayNotEndItsOwnBlock) {
  expect_error("#if (0 #end )", "parentheses of a directive end in another");
  expect_error("#if (0 #end #if (1) ) #end", "parentheses of a directive end in another");
}

TEST(PovLanguage, AMacroMayGiveAConditionsValue) {
  EXPECT_EQ(objects_of("#macro M(A) A > 1 #end #if (M(2)) sphere { 0, 1 } #else #end"), 1u);
}

// ---- values that change while they are used ----------------------------------------------------

TEST(PovLanguage, ReadingAFileIntoItsOwnNameIsHarmless) {
  PovFile file("#fopen F \"numbers.txt\" read #read (F, F, G) sphere { 0, F + G }");
  file.write("numbers.txt", "1, 2, 3");
  EXPECT_EQ(file.load().instances.at(0).object_to_world[0][0], 3.0);
}

// Whatever the scene's own texts hold.
TEST(PovLanguage, MessagesAreOneLine) {
  PovFile named("#include \"shapes.inc\n#include \"");
  EXPECT_NE(named.error().find("shapes.inc #include"), std::string::npos);
  PovFile said("#error \"first\nsecond\"");
  EXPECT_NE(said.error().find("first second"), std::string::npos);
  PovFile warned("#warning \"third\nfourth\"");
  warned.load();
  EXPECT_TRUE(warned.warns("third fourth"));
}

TEST(PovLanguage, AnArrayThatChangesWhileItIsUsedIsAnError) {
  const std::string array = "#declare A = array[8] { 0, 1, 2, 3, 4, 5, 6, 7 }\n";
  expect_error(array + "sphere { 0, A[ #declare A = 3; 5 ] }", "array changes");
  expect_error(array + "#declare A[7] = #declare A = array[1] { 1 } 5;", "array changes");
  expect_error(array + "#declare A[ #declare A = array[1] { 1 } 5 ] = 5;", "array changes");
  expect_error(array + "#ifdef (A[ #declare A = 3; 5 ]) #end", "array changes");
  expect_error(array + "#macro M(P) #end M(A[ #declare A = 3; 5 ])", "array changes");
  EXPECT_EQ(number_of(array, "dimension_size (A, #declare A = 3; 1)"), 8.0);
}

TEST(PovLanguage, MacrosWriteToTheElementsTheyAreGiven) {
  const std::string macro =
      "#macro Set(P, Q) #declare P = 5; #declare A[2] = 7; #declare Q = 6; #end\n";
  const std::string array = "#declare A = array[3] { 1, 2, 3 } Set(A[0], A[1])\n";
  EXPECT_EQ(number_of(macro + array, "A[0] * 100 + A[1] * 10 + A[2]"), 567.0);
}

TEST(PovLanguage, ADeclaredCopyOfAnArrayIsItsOwn) {
  EXPECT_EQ(number_of("#declare A = array[1] { 1 } #declare B = A #declare B[0] = 2;", "A[0]"),
            1.0);
}

TEST(PovLanguage, ASplineNeedsFiniteTimes) {
  const std::string spline = "#declare S = spline { 0, 1, 1, 2 }\n";
  expect_error("#declare S = spline { 1e300 * 1e300 - 1e300 * 1e300, 1 }", "not finite");
  expect_error(spline + "sphere { 0, S(1e300 * 1e300 - 1e300 * 1e300).x }", "not finite");
}

// ---- chains and doublings that loops build -----------------------------------------------------

std::string repeated(int count, const std::string& first, const std::string& again) {
  return "#declare A = " + first + "\n#for (I, 1, " + std::to_string(count) +
         ") #declare A = " + again + " #end\n";
}

TEST(PovLanguage, DeepChainsAreRefused) {
  const std::string words = "hold each other more than";
  const std::string sphere = "sphere { 0, 1 }";
  expect_error(repeated(100000, sphere, "union { object { A } sphere { I, 1 } }") + "object { A }",
               words);
  expect_error(repeated(100000, sphere, "object { sphere { 0, 1 } clipped_by { A } }"), words);
  expect_error(repeated(100000, "array[1] { 1 }", "array[1] { A }"), words);
  expect_error(repeated(100000, "function { x }", "function { A(x, y, z) + 1 }"), words);
  expect_error(
      repeated(100000, "pigment { rgb 1 }", "pigment { gradient x pigment_map { [0 A] } }"), words);
  expect_error(repeated(100000, "normal { bumps }", "normal { gradient x normal_map { [0 A] } }"),
               words);
  expect_error(repeated(100000, "texture { pigment { rgb 1 } }",
                        "texture { gradient x texture_map { [0 A] } }"),
               words);
}

TEST(PovLanguage, LegitimateChainsAreWalked) {
  const std::string chain =
      repeated(1900, "sphere { 0, 1 }", "union { object { A } sphere { I, 1 } }");
  EXPECT_EQ(objects_of(chain + "object { A }"), 1901u);
  EXPECT_EQ(objects_of(chain + "intersection { object { A } box { -9, -8 } } sphere { 0, 1 }"), 1u);
}

TEST(PovLanguage, DoublingsAreRefused) {
  const std::string words = "parts";
  expect_error(
      repeated(40, "sphere { 0, 1 }", "union { object { A } object { A } }") + "object { A }",
      words);
  expect_error(
      repeated(40, "pigment { rgb 1 }", "pigment { gradient x pigment_map { [0 A] [1 A] } }"),
      words);
  expect_error(repeated(40, "normal { bumps }", "normal { gradient x normal_map { [0 A] [1 A] } }"),
               words);
  expect_error(
      repeated(40, "function (x) { x }", "function (x) { A(x) + A(x) }") + "sphere { 0, A(1) }",
      words);
}

TEST(PovLanguage, LayersAndStringsThatDoubleAreRefused) {
  PovFile layers(repeated(40, "texture { pigment { rgb 1 } }", "texture { A } texture { A }"));
  EXPECT_FALSE(layers.error().empty());
  PovFile strings(repeated(100000, "\"0123456789\"", "concat(A, \"x\")"));
  strings.options.max_bytes = 1 << 24;
  EXPECT_NE(strings.error().find("--max-bytes"), std::string::npos);
}

TEST(PovLanguage, FunctionsAreCountedAsSteps) {
  PovFile file(
      "#declare F = function (x) { sum(i, 1, 1e5, sum(j, 1, 1e5, i + j)) }\n"
      "sphere { 0, F(1) }");
  file.options.language.max_steps = 1'000'000;
  EXPECT_NE(file.error().find("--max-steps"), std::string::npos);
}

TEST(PovLanguage, TextsOfWarningsAreBounded) {
  PovFile file("#for (I, 1, 5000) #warning str(I, 0, 0) #end sphere { 0, 1 }");
  file.load();
  EXPECT_LE(file.report.warnings.size(), 1001u);
}

TEST(PovLanguage, TokensAreBounded) {
  PovFile file(std::string(1 << 20, ';'));
  file.options.max_bytes = 1 << 20;
  EXPECT_NE(file.error().find("--max-bytes"), std::string::npos);
}

// ---- numbers and strings -----------------------------------------------------------------------

TEST(PovLanguage, NumbersTooSmallAreZero) {
  EXPECT_EQ(number_of("", "1 + 1e-400"), 1.0);
  expect_error("sphere { 0, 1e400 }", "out of range");
}

TEST(PovLanguage, FileNamesKeepTheirBackslashes) {
  PovFile file("#include \"t\\new.inc\"");
  std::filesystem::create_directories(file.folder / "t");
  file.write("t/new.inc", "sphere { 0, 1 }");
  EXPECT_EQ(file.load().instances.size(), 1u);
}

// ---- hostile files -----------------------------------------------------------------------------

TEST(PovLanguage, ARecursionBombEndsWithALine) {
  expect_error("#macro Bomb(N) Bomb(N + 1) Bomb(N + 2) #end Bomb(0)", "--max-recursion");
}

TEST(PovLanguage, AnEndlessLoopEndsWithALine) {
  PovFile file("#declare I = 0; #while (I < 1) #declare J = I; #end");
  file.options.language.max_steps = 100'000;
  EXPECT_NE(file.error().find("--max-steps"), std::string::npos);
}

// Once each, however often they are included.
TEST(PovLanguage, TellsWhichFilesItRead) {
  PovFile file("#include \"a.inc\"\n#include \"a.inc\"\nsphere { 0, Size }\n");
  file.write("a.inc", "#include \"parts/b.inc\"\n");
  std::filesystem::create_directories(file.folder / "parts");
  file.write("parts/b.inc", "#declare Size = 1;\n");
  file.write("unused.inc", "#declare Size = 2;\n");
  file.load();
  const std::filesystem::path folder = std::filesystem::canonical(file.folder);
  EXPECT_EQ(file.report.files,
            (std::vector<std::filesystem::path>{folder / "a.inc", folder / "parts" / "b.inc"}));
}

TEST(PovLanguage, AnIncludeOutsideTheFolderEndsWithALine) {
  PovFile file("#include \"../outside.inc\"");
  file.write("../outside.inc", "sphere { 0, 1 }");
  EXPECT_NE(file.error().find("outside"), std::string::npos);
  std::filesystem::remove(file.folder / "../outside.inc");
  expect_error("#include \"/etc/hostname\"", "/etc/hostname");
}

}  // namespace
