; A cart drives through the rooms of a ward. A door opens with its key, and a wet floor is not crossed.
(define (domain ward)
  (:requirements :strips :typing :negative-preconditions :equality :disjunctive-preconditions
                 :action-costs)
  (:types room key)
  (:constants depot - room)
  (:predicates (at ?r - room) (beside ?a - room ?b - room) (locked ?r - room) (opens ?k - key ?r - room)
               (lies ?k - key ?r - room) (carried ?k - key) (wet ?r - room))
  (:functions (total-cost) - number (steps ?a - room ?b - room) - number)

  (:action drive
    :parameters (?a - room ?b - room)
    :precondition (and (at ?a) (not (= ?a ?b)) (or (beside ?a ?b) (beside ?b ?a))
                       (not (locked ?b)) (not (wet ?b)))
    :effect (and (at ?b) (not (at ?a)) (increase (total-cost) (steps ?a ?b))))

  (:action take
    :parameters (?k - key ?r - room)
    :precondition (and (at ?r) (lies ?k ?r))
    :effect (and (carried ?k) (not (lies ?k ?r)) (increase (total-cost) 1)))

  (:action leave
    :parameters (?k - key)
    :precondition (and (at depot) (carried ?k))
    :effect (and (lies ?k depot) (not (carried ?k)) (increase (total-cost) 1)))

  (:action open
    :parameters (?a - room ?b - room ?k - key)
    :precondition (and (at ?a) (or (beside ?a ?b) (beside ?b ?a)) (locked ?b)
                       (opens ?k ?b) (carried ?k))
    :effect (and (not (locked ?b)) (increase (total-cost) 3))))
