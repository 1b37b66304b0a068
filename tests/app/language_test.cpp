// Help and messages in German: what the options are called, exit codes and results stay.
#include <regex>
#include <set>

#include "command_line.hpp"

namespace turnwright::app {
namespace {

std::set<std::string> options(const std::string& help) {
  static const std::regex kOption("--[a-z][a-z-]+");
  std::set<std::string> all;
  for (std::sregex_iterator it(help.begin(), help.end(), kOption), end; it != end; ++it)
    all.insert(it->str());
  return all;
}

TEST_F(CommandLine, EveryHelpIsGermanWithTheSameOptions) {
  for (const auto& row : service::requests()) {
    const auto english = shell("turnwright " + row.name + " --help");
    const auto german = shell("turnwright --language de " + row.name + " --help");
    EXPECT_EQ(german.code, 0);
    EXPECT_EQ(options(german.out), options(english.out)) << row.name;
    for (const char* words : {"Aufruf: turnwright ", "\nArgumente:\n", "\nOptionen:\n",
                              "zeigt diese Hilfe", "\nBeispiel"})
      EXPECT_NE(german.out.find(words), std::string::npos) << row.name << ' ' << words;
    for (const char* words : {"Usage", "Options", "REQUIRED", "Example", "print "})
      EXPECT_EQ(german.out.find(words), std::string::npos) << row.name << ' ' << words;
    EXPECT_EQ(german.out.find(row.summary), std::string::npos) << row.name;
  }
}

TEST_F(CommandLine, TheVariableSpeaksAsTheOptionDoes) {
  const auto option = shell("turnwright --help --language=de");
  EXPECT_EQ(shell("TURNWRIGHT_LANGUAGE=de turnwright --help").out, option.out);
  EXPECT_NE(option.out, shell("turnwright --help").out);
  EXPECT_EQ(shell("TURNWRIGHT_LANGUAGE=de turnwright --language en --help").out,
            shell("turnwright --help").out);
}

TEST_F(CommandLine, AnEmptyVariableAsksForNoLanguage) {
  const auto empty = shell("TURNWRIGHT_LANGUAGE= turnwright --help");
  EXPECT_EQ(empty.code, 0) << empty.err;
  EXPECT_EQ(empty.out, shell("turnwright --help").out);
}

TEST_F(CommandLine, ABatchIsOfOneLanguage) {
  put(folder_ / "lines.jsonl", "{\"name\": \"plan\", \"document\": {}}\n");
  const std::string batch = " batch lines.jsonl -o results";
  EXPECT_EQ(shell("turnwright --language de" + batch + " --shard 1/1").code, 0);
  const auto english = shell("turnwright" + batch);
  EXPECT_EQ(english.code, 2);
  EXPECT_TRUE(english.err.starts_with("results/manifest.json: /data_sha256: got "))
      << english.err;
  EXPECT_EQ(shell("turnwright --language de" + batch).code, 0);
}

TEST_F(CommandLine, TasksOfAClusterSpeakTheLanguageOfTheirBatch) {
  put(folder_ / "lines.jsonl", "{\"name\": \"plan\", \"document\": {}}\n");
  put(folder_ / "sbatch", "#!/bin/sh\necho 1\n");
  put(folder_ / "squeue", "#!/bin/sh\n");
  for (const char* command : {"sbatch", "squeue"})
    fs::permissions(folder_ / command, fs::perms::owner_all);
  const auto run =
      shell("PATH=.:$PATH turnwright --language de batch lines.jsonl -o results --slurm");
  EXPECT_EQ(run.code, 0) << run.err;
  const auto script = contents(folder_ / "results/work/slurm.sh");
  EXPECT_NE(script.find(" --language de batch "), std::string::npos) << script;
}

TEST_F(CommandLine, AWrongCommandLineIsRefusedInBothLanguages) {
  struct Wrong {
    std::string arguments, english, german;
  };
  const std::vector<Wrong> all{
      {"plan", "REQUEST is required\n", "REQUEST fehlt\n"},
      {"plan a b", "The following argument was not expected: b\n",
       "Dieses Argument wird nicht erwartet: b\n"},
      {"plan a b c", "The following arguments were not expected: c b\n",
       "Diese Argumente werden nicht erwartet: c b\n"},
      {"plan a --cycles", "--cycles requires --nc\n", "--cycles verlangt --nc\n"},
      {"batch a -o b --slurm --reconcile", "--slurm excludes --reconcile\n",
       "--slurm und --reconcile schließen sich aus\n"},
      {"list some", "WHAT: some not in {", "WHAT: some ist keines von {"},
      {"plan a -o b -o c", "--output: at most 1, but given 2 times\n",
       "--output: höchstens 1, aber 2-mal gegeben\n"},
      {"plan --nc", "--nc: 1 required TEXT missing\n", "--nc: es fehlt: 1 TEXT\n"}};
  for (const auto& wrong : all) {
    const auto english = shell("turnwright " + wrong.arguments);
    const auto german = shell("turnwright --language=de " + wrong.arguments);
    EXPECT_EQ(english.code, 2) << english.err;
    EXPECT_EQ(german.code, 2) << german.err;
    EXPECT_TRUE(english.err.starts_with(wrong.english)) << english.err;
    EXPECT_TRUE(german.err.starts_with(wrong.german)) << german.err;
    EXPECT_TRUE(english.err.ends_with("Run with --help for more information.\n"));
    EXPECT_TRUE(german.err.ends_with("Mehr mit --help.\n"));
  }
  EXPECT_EQ(shell("turnwright --language de").err,
            "Ein Befehl fehlt\nMehr mit --help.\n");
}

TEST_F(CommandLine, PlacesInALineOfTextAreToldInGerman) {
  put(folder_ / "wrong.txt", "d32 x 3O\n");
  const auto wrong = shell("turnwright --language de import wrong.txt --material C45");
  EXPECT_EQ(wrong.code, 2);
  EXPECT_NE(wrong.err.find("gegeben Zeile 1, Spalte "), std::string::npos) << wrong.err;
}

TEST_F(CommandLine, APictureOfAWindowNamesItsCostInGerman) {
  put(folder_ / "request.json", row("plan").example);
  const auto run = shell("turnwright --language de plan request.json --drawings .");
  EXPECT_EQ(run.code, 0) << run.err;
  const auto window = shell("cat window-*.svg").out;
  EXPECT_NE(window.find("  Kosten +5 %"), std::string::npos) << window;
  EXPECT_EQ(window.find("cost"), std::string::npos) << window;
}

TEST_F(CommandLine, ARoutingNamesTheClampingInGerman) {
  put(folder_ / "request.json", row("quote").example);
  const auto german = shell("turnwright --language de quote request.json --json");
  EXPECT_EQ(german.code, 0) << german.err;
  EXPECT_NE(german.out.find("\"drehen, linkes Ende gespannt, Spannfutter\""),
            std::string::npos)
      << german.out;
}

TEST_F(CommandLine, AResultIsTheSameInBothLanguages) {
  put(folder_ / "request.json", row("multipass").example);
  const auto german = shell("turnwright --language de multipass request.json --json");
  EXPECT_EQ(german.code, 0) << german.err;
  EXPECT_EQ(german.out, shell("turnwright multipass request.json --json").out);
}

}  // namespace
}  // namespace turnwright::app
