#!/bin/sh
# outside.sh BUILD SOURCE: installs a build into its own folder and builds outside projects against it. Exits with 1 and the
# reason if a project fails to build or computes other results than the installed program.
set -eu
build=$1 source=$2
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
cmake --install "$build" --prefix "$scratch/prefix" >"$scratch/log"

project() { # NAME [FOLDER]
  {
    cmake -S "${2:-$source/tests/install/$1}" -B "$scratch/$1" -G Ninja -DCMAKE_PREFIX_PATH="$scratch/prefix" &&
      cmake --build "$scratch/$1"
  } >"$scratch/$1.log" 2>&1 || {
    echo "outside.sh: the project $1 does not build:"
    cat "$scratch/$1.log"
    exit 1
  }
}
expect() { # FOUND EXPECTED
  case $1 in $2) ;; *) echo "outside.sh: expected $2, found $1" && exit 1 ;; esac
}

# The project of docs/cookbook/library.md: its files are the blocks after a comment with their name.
mkdir "$scratch/page"
for file in CMakeLists.txt main.cpp; do
  sed -n "/^<!-- file: $file -->\$/,/^\`\`\`\$/p" "$source/docs/cookbook/library.md" | sed '1,2d;$d' >"$scratch/page/$file"
done
project mine "$scratch/page"
expect "$(cd "$scratch/mine" && ./mine)" '-* m'

project cloth
expect "$("$scratch/cloth/cloth")" '1 s, lowest at -*'

project scene
scene=$source/scenes/homework/4.toml
"$scratch/scene/scene" "$scene" >"$scratch/library.csv"
"$scratch/prefix/bin/drape" simulate --quiet "$scene" --positions "$scratch/program.csv"
cmp "$scratch/library.csv" "$scratch/program.csv"

project examples
public=$(grep -rh '^// Example:$' "$source/include/drape" | wc -l)
grep -q " $public examples" "$scratch/examples.log" || { echo "outside.sh: an example was left out" && exit 1; }
expect "$("$scratch/examples/picture")" 'middle 1 0, corner 0 255'

# The Python module, if it was built: it finds its dependencies beside it, including a texture's decoder.
for packages in "$scratch"/prefix/lib/python3*/dist-packages; do
  [ -d "$packages" ] || continue
  expect "$(PYTHONPATH=$packages "${PYTHON:-/usr/bin/python3}" -c '
import sys, drape
simulation = drape.Simulation(sys.argv[1], set={"look.texture": "plaid.png"})
simulation.step(5)
print(drape.data_folder(), drape.render(simulation, size=(64, 48)).shape)' "$scene")" "$scratch/prefix/share/drape (48, 64, 3)"
done

# Installed files must not name the build tree.
if grep -rl "$source" "$scratch/prefix/lib" "$scratch/prefix/include" --include='*.cmake' --include='*.hpp'; then
  echo "outside.sh: these files name the source tree" && exit 1
fi
