#pragma once

namespace baraka::run::network {

/// Gives this thread a real-time priority, if the system permits: frames wait for it, and it needs
/// little processor time. Child processes keep the normal priority.
/// @param before  false: the normal one again.
void go_before_others(bool before);

/// A thread of a program that makes this one go on is about to wait. It does so first.
void let_others_finish();

}  // namespace baraka::run::network
