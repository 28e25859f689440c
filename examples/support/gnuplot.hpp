#pragma once
// Draws what a program has written with a script of examples/plots, where gnuplot is there.

#include <cstdlib>
#include <filesystem>
#include <string>

#ifndef WHEELRAIL_PLOTS_DIR
#define WHEELRAIL_PLOTS_DIR "examples/plots"
#endif

namespace examples {

enum class DrawStatus { drawn, no_gnuplot, failed };

struct Drawing {
  DrawStatus status{};
  std::string command;  // that draws the PNG file, for a shell
};

namespace detail {

[[nodiscard]] inline std::string shell_quoted(const std::string& word) {
  std::string text(1, '\'');
  for (const char c : word) {
    if (c == '\'') text.append("'\\'");
    text += c;
  }
  return text.append(1, '\'');
}

}  // namespace detail

// Draws <name>.png and <name>.svg into the directory, both or none. `title` is free text.
[[nodiscard]] inline Drawing draw(const std::filesystem::path& directory, const std::string& name,
                                  const std::string& title) {
  namespace fs = std::filesystem;
  const fs::path script = fs::absolute(fs::path(WHEELRAIL_PLOTS_DIR) / (name + ".gp"));
  std::string plain_title;
  for (const char c : title) plain_title += c == '\'' || c == '\\' || c == '"' ? '_' : c;
  const auto command = [&](const std::string& terminal, const std::string& extension) {
    const std::string set = std::string("data='.'; heading='")
                                .append(plain_title)
                                .append("'; set terminal ")
                                .append(terminal)
                                .append("; set output '")
                                .append(name)
                                .append(extension)
                                .append("'");
    return std::string("cd ")
        .append(detail::shell_quoted(fs::absolute(directory).string()))
        .append(" && gnuplot -e ")
        .append(detail::shell_quoted(set))
        .append(" ")
        .append(detail::shell_quoted(script.string()));
  };
  Drawing drawing{DrawStatus::no_gnuplot, command("pngcairo size 1400,1050 font \",11\"", ".png")};
  if (std::system("command -v gnuplot >/dev/null 2>&1") != 0) return drawing;
  drawing.status = DrawStatus::drawn;
  const std::string svg =
      command("svg size 1400,1050 dynamic font \",14\" background \"white\"", ".svg");
  for (const std::string& each : {drawing.command, svg}) {
    if (std::system(each.c_str()) != 0) drawing.status = DrawStatus::failed;
  }
  if (drawing.status == DrawStatus::failed) {
    std::error_code ignored;
    for (const char* extension : {".png", ".svg"})
      fs::remove(directory / (name + extension), ignored);
  }
  return drawing;
}

}  // namespace examples
