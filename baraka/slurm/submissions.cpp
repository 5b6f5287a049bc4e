#include "baraka/slurm/submissions.h"

#include <fmt/format.h>
#include <sys/random.h>

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace baraka::slurm {
namespace {

constexpr const char* kCampaign = "slurm.campaign";

std::string random_name() {
  std::uint32_t bits = 0;
  if (::getrandom(&bits, sizeof bits, 0) != sizeof bits) {
    throw std::runtime_error("no random bits for the name of a job");
  }
  return fmt::format("{:08x}", bits);
}

Submission submission_in(const std::string& key, const std::string& note) {
  std::istringstream in(note);
  Submission submission;
  std::string job;
  if (!(in >> submission.name >> submission.first)) {
    throw std::runtime_error(fmt::format("{}: '{}' notes no job of Slurm", key, note));
  }
  if (std::int64_t number = 0; in >> number) submission.job = number;
  return submission;
}

}  // namespace

Submissions::Submissions(Notes notes)
    : notes_(std::move(notes)), campaign_(notes_.value(kCampaign)) {
  for (std::size_t number = 1;; ++number) {
    const std::string key = fmt::format("slurm.{}", number), note = notes_.value(key);
    if (note.empty()) break;
    all_.push_back(submission_in(key, note));
  }
}

std::set<std::string> Submissions::names() const {
  std::set<std::string> names;
  for (const Submission& submission : all_) names.insert(submission.name);
  return names;
}

const Submission* Submissions::named(std::string_view name) const {
  const auto found = std::ranges::find(all_, name, &Submission::name);
  return found == all_.end() ? nullptr : &*found;
}

const Submission& Submissions::add(std::int64_t first) {
  if (campaign_.empty()) {
    campaign_ = random_name();
    notes_.set(kCampaign, campaign_);
  }
  all_.push_back({fmt::format("baraka-{}-{}", campaign_, all_.size() + 1), first, std::nullopt});
  note(all_.size() - 1);
  return all_.back();
}

void Submissions::set_job(std::int64_t job) {
  all_.back().job = job;
  note(all_.size() - 1);
}

void Submissions::note(std::size_t index) {
  const Submission& submission = all_[index];
  std::string text = fmt::format("{} {}", submission.name, submission.first);
  if (submission.job) text += fmt::format(" {}", *submission.job);
  notes_.set(fmt::format("slurm.{}", index + 1), text);
}

}  // namespace baraka::slurm
