namespace lancer {
int run(int argc, char** argv);
int run(int, char**) { return 0; }
}  // namespace lancer
