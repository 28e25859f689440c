#include <cmath>
#include <random>
#include <string>
#include <vector>
#include <wheelrail/io/profile_file.hpp>

#include "io/sample_profiles.hpp"
#include "support/catch.hpp"

using namespace wheelrail;
using namespace wheelrail_test;

namespace {

using Random = std::mt19937;

std::size_t pick(Random& random, std::size_t count) {
  return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
}

// One change of a file: a bit, a byte, a piece, a line or a number that files may hold.
void mutate(std::string& text, Random& random) {
  static const std::vector<std::string> pieces{"nan",
                                               "inf",
                                               "-inf",
                                               "1e400",
                                               "1e308",
                                               "-1e308",
                                               "1e-400",
                                               "-1",
                                               "0",
                                               "1",
                                               ",",
                                               ";",
                                               "\t",
                                               "=",
                                               "!",
                                               "'",
                                               "#",
                                               "*",
                                               "\r",
                                               "\n",
                                               "\xEF\xBB\xBF",
                                               std::string(1, '\0'),
                                               "\xFF",
                                               "1,5",
                                               "99999999999999999999",
                                               "point.begin\n",
                                               "point.end\n",
                                               "spline.end\n",
                                               "header.begin\n",
                                               "rotate = 1e308\n",
                                               "units.len.f = 1e-308\n",
                                               "units.len.f = 1e308\n",
                                               "bound.y.min = -1e308\n",
                                               "XYPoints=-1\n",
                                               "XOffset=1e308\n",
                                               "ColumnDef=Y,X\n",
                                               "ColumnDef=*\n",
                                               "lateral,value\n"};
  const auto line_at = [&text](std::size_t i) {
    const std::size_t begin = i == 0 ? 0 : text.rfind('\n', i - 1) + 1;
    const std::size_t end = std::min(text.find('\n', i), text.size() - 1) + 1;
    return std::pair{begin, end - begin};
  };
  if (text.empty()) text = "0";
  const std::size_t at = pick(random, text.size());
  switch (pick(random, 8)) {
    case 0:
      text[at] = static_cast<char>(static_cast<unsigned char>(text[at]) ^ (1U << pick(random, 8)));
      break;
    case 1:
      text.erase(at, 1 + pick(random, 20));
      break;
    case 2:
      text.insert(at, pieces[pick(random, pieces.size())]);
      break;
    case 3:
      text.resize(at);
      break;
    case 4: {
      const auto [begin, length] = line_at(at);
      text.insert(begin, text.substr(begin, length));
      break;
    }
    case 5: {
      const auto [begin, length] = line_at(at);
      text.erase(begin, length);
      break;
    }
    case 6: {
      const auto [begin, length] = line_at(at);
      text.insert(begin, pieces[pick(random, pieces.size())]);
      break;
    }
    default:
      text[at] = static_cast<char>(pick(random, 256));
      break;
  }
}

bool is_finite_everywhere(const ProfilePoints<double>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!std::isfinite(points.lateral[i]) || !std::isfinite(points.value[i])) return false;
  }
  return points.size() >= 4 && points.value.size() == points.size();
}

// "<name>:<line>: <reason>", one printable line.
bool names_file_and_line(const std::string& what, const std::string& name, std::size_t bytes) {
  if (!what.starts_with(name + ":")) return false;
  std::size_t i = name.size() + 1, line = 0;
  const std::size_t digits = i;
  for (; i < what.size() && what[i] >= '0' && what[i] <= '9'; ++i) {
    line = 10 * line + static_cast<std::size_t>(what[i] - '0');
  }
  if (i == digits || line < 1 || line > bytes + 1) return false;
  if (what.substr(i, 2) != ": " || what.size() < i + 10 || what.size() > 400) return false;
  for (const char c : what) {
    if (c < ' ' || c > '~') return false;
  }
  return true;
}

}  // namespace

TEST_CASE("parse_profile: changed files give finite points or name file and line", "[io][random]") {
  struct Sample {
    ProfileKind kind;
    std::string text;
  };
  constexpr auto wheel = ProfileKind::wheel;
  constexpr auto rail = ProfileKind::rail;
  const std::vector<Sample> samples{
      {wheel, simpack_text(true, "units.len.f = 1000\nshift.y = 1\nrotate = 0\n",
                           rows(wheel_points(12), 1e3, 1e3))},
      {rail, simpack_text(false,
                          "bound.y.min = -0.03\nbound.y.max = 0.03\nmirror.y = 1\nrotate = 0.01\n"
                          "units.len = 'm'\nunits.ang = 'rad'\n",
                          rows(rail_points(12), 1, -1, " ", " 1.0\n"))},
      {rail, "Date=1\nXOffset=1\nColumnDef=X,Y,*\n\n" + rows(rail_points(12), 1e3, 1e3)},
      {wheel, "# a wheel\ny [mm],z [mm]\n" + rows(wheel_points(12), 1e3, -1e3, ",", "\r\n")},
      {wheel, profile_text(wheel_points(12), wheel, {.format = ProfileFormat::miniprof})},
      {rail, profile_text(rail_points(12), rail, {.comments = {"a rail"}})},
      {rail, rows(rail_points(12), -1, 1, ";")},
  };
  Random random(20240917);
  int read = 0, refused = 0;
  for (const Sample& sample : samples) {
    REQUIRE(is_finite_everywhere(parse_profile(sample.text, "f.txt", sample.kind).points));
    for (int trial = 0; trial < 4000; ++trial) {
      std::string text = sample.text;
      for (std::size_t changes = 1 + pick(random, 4); changes > 0; --changes) mutate(text, random);
      try {
        const auto file = parse_profile(text, "f.txt", sample.kind);
        if (!is_finite_everywhere(file.points)) {
          FAIL("points are missing or not finite, from:\n" << text);
        }
        (void)diagnose_points(file.points);
        ++read;
      } catch (const std::invalid_argument& error) {
        if (!names_file_and_line(error.what(), "f.txt", text.size())) {
          FAIL("the error is: " << error.what() << "\nfrom:\n" << text);
        }
        ++refused;
      }
    }
  }
  CHECK(read > 3000);
  CHECK(refused > 8000);
}

TEST_CASE("parse_profile: bytes at random give finite points or name file and line",
          "[io][random]") {
  Random random(3);
  const std::string alphabet = "0123456789.,;-+eE \t\r\n=!#'*xymnaif";
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text(pick(random, 200), ' ');
    for (char& c : text) c = alphabet[pick(random, alphabet.size())];
    try {
      const auto file = parse_profile(text, "f.txt", ProfileKind::rail);
      if (!is_finite_everywhere(file.points)) FAIL("not finite, from:\n" << text);
    } catch (const std::invalid_argument& error) {
      if (!names_file_and_line(error.what(), "f.txt", text.size())) FAIL(error.what());
    }
  }
}

TEST_CASE("parse_profile: long inputs end soon", "[io]") {
  const auto refuses = [](const std::string& text) {
    CHECK_THROWS_AS(parse_profile(text, "f.txt", ProfileKind::rail), std::invalid_argument);
  };
  refuses(std::string(4000000, '1'));
  refuses(std::string(4000000, ','));
  refuses(std::string(4000000, '\n'));
  refuses(std::string(4000000, ' '));
  refuses(std::string("a=").append(std::string(4000000, '\'')));
  std::string columns = "ColumnDef=X,Y";
  for (int i = 0; i < 500000; ++i) columns += ",A";
  refuses(columns);
  std::string keys = "spline.begin\n";
  for (int i = 0; i < 200000; ++i) keys.append("k").append(std::to_string(i)).append("=1\n");
  refuses(keys);
  std::string points;
  for (int i = 0; i < 200000; ++i) points += "1 2\n";
  refuses(points);
}
