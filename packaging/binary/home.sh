# In shells other than bash and zsh, TALUS_HOME says which folder has lib/talus (default /usr).
if [ -n "${BASH_VERSION:-}" ]; then
  talus_home=$(dirname "${BASH_SOURCE:-$0}")/../..
elif [ -n "${ZSH_VERSION:-}" ]; then
  eval 'talus_home=${${(%):-%x}:A:h:h:h}'
else
  talus_home=${TALUS_HOME:-/usr}
fi
talus_home=$(cd "$talus_home" && pwd)
