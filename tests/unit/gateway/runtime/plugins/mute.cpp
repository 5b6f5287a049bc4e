/// A library that is no controller.
int answer_of_mute() { return 0; }
