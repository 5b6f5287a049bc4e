#include "programs/netns/loadable.h"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace programs::netns {
namespace {

constexpr int kMostScripts = 4;  // nested scripts; Linux has the same limit

template <class T>
std::optional<T> read_at(std::ifstream& file, std::uint64_t place) {
  T value;
  file.clear();
  file.seekg(static_cast<std::streamoff>(place));
  if (!file.read(reinterpret_cast<char*>(&value), sizeof value)) return std::nullopt;
  return value;
}

std::string text_at(std::ifstream& file, std::uint64_t place, std::size_t length) {
  std::string text(length, '\0');
  file.clear();
  file.seekg(static_cast<std::streamoff>(place));
  file.read(text.data(), static_cast<std::streamsize>(length));
  text.resize(text.find('\0') == std::string::npos ? text.size() : text.find('\0'));
  return text;
}

/// File name of the loader that a program asks for, e.g. ld-linux-x86-64.so.2; nullopt: none.
std::optional<std::string> loader_of(std::ifstream& file, const ElfW(Ehdr) & header) {
  for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
    const auto part = read_at<ElfW(Phdr)>(file, header.e_phoff + i * header.e_phentsize);
    if (!part || part->p_type != PT_INTERP || part->p_filesz > PATH_MAX) continue;
    const std::filesystem::path loader = text_at(file, part->p_offset, part->p_filesz);
    return loader.filename().string();
  }
  return std::nullopt;
}

/// The interpreter of a script, from "#! /path arguments"; nullopt if the file is not a script.
std::optional<std::filesystem::path> interpreter_of(std::ifstream& file) {
  file.clear();
  file.seekg(0);
  std::string line;
  if (!std::getline(file, line) || !line.starts_with("#!")) return std::nullopt;
  const std::size_t begin = line.find_first_not_of(" \t", 2);
  if (begin == std::string::npos) return std::nullopt;
  return line.substr(begin, line.find_first_of(" \t", begin) - begin);
}

bool is_elf(const std::optional<ElfW(Ehdr)>& header) {
  return header && std::string_view(reinterpret_cast<const char*>(header->e_ident), SELFMAG) ==
                       std::string_view(ELFMAG, SELFMAG);
}

/// The ELF header of this program: the library is built for the same machine. nullopt: it cannot be
/// read.
std::optional<ElfW(Ehdr)> own_header(std::ifstream& self) {
  const auto header = read_at<ElfW(Ehdr)>(self, 0);
  return is_elf(header) ? header : std::nullopt;
}

std::optional<std::string> why_not_elf(std::ifstream& file, const ElfW(Ehdr) & header) {
  std::ifstream self("/proc/self/exe", std::ios::binary);
  const auto own = own_header(self);
  if (!own) return "cannot be checked without /proc";
  if (header.e_ident[EI_CLASS] != own->e_ident[EI_CLASS] || header.e_machine != own->e_machine) {
    return "is a program of another kind of machine";
  }
  const auto loader = loader_of(file, header);
  if (!loader) return "is statically linked";
  const auto own_loader = loader_of(self, *own);
  if (own_loader && *loader != *own_loader) {
    return fmt::format("is linked with another C library ({})", *loader);
  }
  return std::nullopt;
}

/// `env`, as in "#! /usr/bin/env python3", is dynamically linked. The program that it starts is not
/// checked here.
std::optional<std::string> why_not_at(const std::filesystem::path& program, int scripts) {
  std::ifstream file(program, std::ios::binary);
  if (!file) return "cannot be read";
  const auto header = read_at<ElfW(Ehdr)>(file, 0);
  if (is_elf(header)) return why_not_elf(file, *header);
  const auto interpreter = interpreter_of(file);
  if (!interpreter) return "is neither a program nor a script";
  if (scripts == 0) return "is a script of a script of a script";
  const auto why = why_not_at(*interpreter, scripts - 1);
  if (!why) return std::nullopt;
  return fmt::format("is run by {}, which {}", interpreter->string(), *why);
}

}  // namespace

std::filesystem::path program_file(const std::string& name, const std::string& folders) {
  const auto may_run = [](const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) && access(file.c_str(), X_OK) == 0;
  };
  if (name.find('/') != std::string::npos) {
    if (may_run(name)) return std::filesystem::absolute(name);
    throw std::runtime_error(fmt::format("{} is not a program that can be started", name));
  }
  for (std::size_t begin = 0; begin <= folders.size();) {
    const std::size_t end = std::min(folders.find(':', begin), folders.size());
    const std::filesystem::path folder = folders.substr(begin, end - begin);
    const auto file = (folder.empty() ? std::filesystem::path(".") : folder) / name;
    if (!name.empty() && may_run(file)) return std::filesystem::absolute(file);
    begin = end + 1;
  }
  throw std::runtime_error(fmt::format("no program '{}' in PATH ({})", name, folders));
}

std::optional<std::string> why_not_preloaded(const std::filesystem::path& program) {
  return why_not_at(program, kMostScripts);
}

void require_preloaded(const std::filesystem::path& program, const ProgramTime& time) {
  if (!time.needs_library()) return;
  const auto why = why_not_preloaded(program);
  if (!why) return;
  if (time.is_held) {
    throw std::runtime_error(
        fmt::format("{} {}, so lock-step cannot hold it; run it in real time (--pace realtime), or "
                    "use a dynamically linked one",
                    program.string(), *why));
  }
  throw std::runtime_error(
      fmt::format("{} {}, so its time cannot be slowed; run it at a factor of 1 (--pace realtime), "
                  "or use a dynamically linked one",
                  program.string(), *why));
}

}  // namespace programs::netns
